// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: the functions of MED's library, which is loaded at the first call. Few runs read
/// or write MED files, and the library depends on an HDF5 built with MPI and on Open MPI.
#pragma once

#include "rubato/core/dynamic_library.hpp"

#include <med.h>

namespace rubato::mesh::med {

/// The members are named after MED's functions, with n, Cr, Rd and Wr written out: mesh_entity_count is
/// MEDmeshnEntity, mesh_create is MEDmeshCr.
struct Calls {
  DynamicLibrary library;
  decltype(&MEDfamilyCr) family_create = library.symbol("MEDfamilyCr");
  decltype(&MEDfamilyInfo) family_info = library.symbol("MEDfamilyInfo");
  decltype(&MEDfieldComputingStepInfo) field_computing_step_info =
      library.symbol("MEDfieldComputingStepInfo");
  decltype(&MEDfieldCr) field_create = library.symbol("MEDfieldCr");
  decltype(&MEDfieldInfo) field_info = library.symbol("MEDfieldInfo");
  decltype(&MEDfieldnComponent) field_component_count = library.symbol("MEDfieldnComponent");
  decltype(&MEDfieldnComponentByName) field_component_count_by_name =
      library.symbol("MEDfieldnComponentByName");
  decltype(&MEDfieldnProfile) field_profile_count = library.symbol("MEDfieldnProfile");
  decltype(&MEDfieldnValueWithProfile) field_value_count_with_profile =
      library.symbol("MEDfieldnValueWithProfile");
  decltype(&MEDfieldValueWithProfileRd) field_value_with_profile_read =
      library.symbol("MEDfieldValueWithProfileRd");
  decltype(&MEDfieldValueWithProfileWr) field_value_with_profile_write =
      library.symbol("MEDfieldValueWithProfileWr");
  decltype(&MEDfieldValueWr) field_value_write = library.symbol("MEDfieldValueWr");
  decltype(&MEDfileClose) file_close = library.symbol("MEDfileClose");
  decltype(&MEDfileNumVersionRd) file_num_version_read = library.symbol("MEDfileNumVersionRd");
  decltype(&MEDfileObjectExist) file_object_exist = library.symbol("MEDfileObjectExist");
  decltype(&MEDfileOpen) file_open = library.symbol("MEDfileOpen");
  decltype(&MEDgetGeometryTypeName) get_geometry_type_name = library.symbol("MEDgetGeometryTypeName");
  decltype(&MEDlibraryClose) library_close = library.symbol("MEDlibraryClose");
  decltype(&MEDlocalizationWr) localization_write = library.symbol("MEDlocalizationWr");
  decltype(&MEDmeshComputationStepInfo) mesh_computation_step_info =
      library.symbol("MEDmeshComputationStepInfo");
  decltype(&MEDmeshCr) mesh_create = library.symbol("MEDmeshCr");
  decltype(&MEDmeshElementConnectivityRd) mesh_element_connectivity_read =
      library.symbol("MEDmeshElementConnectivityRd");
  decltype(&MEDmeshElementConnectivityWr) mesh_element_connectivity_write =
      library.symbol("MEDmeshElementConnectivityWr");
  decltype(&MEDmeshEntityFamilyNumberRd) mesh_entity_family_number_read =
      library.symbol("MEDmeshEntityFamilyNumberRd");
  decltype(&MEDmeshEntityFamilyNumberWr) mesh_entity_family_number_write =
      library.symbol("MEDmeshEntityFamilyNumberWr");
  decltype(&MEDmeshEntityInfo) mesh_entity_info = library.symbol("MEDmeshEntityInfo");
  decltype(&MEDmeshEntityNameRd) mesh_entity_name_read = library.symbol("MEDmeshEntityNameRd");
  decltype(&MEDmeshEntityNameWr) mesh_entity_name_write = library.symbol("MEDmeshEntityNameWr");
  decltype(&MEDmeshEntityNumberRd) mesh_entity_number_read = library.symbol("MEDmeshEntityNumberRd");
  decltype(&MEDmeshEntityNumberWr) mesh_entity_number_write = library.symbol("MEDmeshEntityNumberWr");
  decltype(&MEDmeshInfo) mesh_info = library.symbol("MEDmeshInfo");
  decltype(&MEDmeshnAxis) mesh_axis_count = library.symbol("MEDmeshnAxis");
  decltype(&MEDmeshnEntity) mesh_entity_count = library.symbol("MEDmeshnEntity");
  decltype(&MEDmeshNodeCoordinateRd) mesh_node_coordinate_read = library.symbol("MEDmeshNodeCoordinateRd");
  decltype(&MEDmeshNodeCoordinateWr) mesh_node_coordinate_write = library.symbol("MEDmeshNodeCoordinateWr");
  decltype(&MEDnFamily) family_count = library.symbol("MEDnFamily");
  decltype(&MEDnFamilyGroup) family_group_count = library.symbol("MEDnFamilyGroup");
  decltype(&MEDnField) field_count = library.symbol("MEDnField");
  decltype(&MEDnMesh) mesh_count = library.symbol("MEDnMesh");
  decltype(&MEDprofileRd) profile_read = library.symbol("MEDprofileRd");
  decltype(&MEDprofileSizeByName) profile_size_by_name = library.symbol("MEDprofileSizeByName");
};

/// Throws InputError when the library cannot be loaded.
const Calls& library();

} // namespace rubato::mesh::med
