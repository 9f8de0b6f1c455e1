// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the functions of serial HDF5, which is loaded at the first call.
#pragma once

#include "rubato/core/dynamic_library.hpp"

#include <hdf5.h>

namespace rubato::results {

/// Flags of H5Fcreate and H5Fopen (H5F_ACC_RDONLY, RDWR and TRUNC). The macros of hdf5.h call functions of
/// the library, and a program that is not linked with HDF5 cannot use them.
struct Hdf5Access {
  static constexpr unsigned read = 0x0000;
  static constexpr unsigned read_and_write = 0x0001;
  static constexpr unsigned truncate = 0x0002;
};

/// The members are named after HDF5's functions, with the letter of the interface written out: dataset_open
/// is H5Dopen2, properties_create is H5Pcreate.
struct Hdf5Calls {
  DynamicLibrary library;
  decltype(&H5open) open = library.symbol("H5open");
  decltype(&H5Eset_auto2) error_set_auto = library.symbol("H5Eset_auto2");

  decltype(&H5Fcreate) file_create = library.symbol("H5Fcreate");
  decltype(&H5Fopen) file_open = library.symbol("H5Fopen");
  decltype(&H5Fflush) file_flush = library.symbol("H5Fflush");
  decltype(&H5Fclose) file_close = library.symbol("H5Fclose");

  decltype(&H5Gcreate2) group_create = library.symbol("H5Gcreate2");
  decltype(&H5Gclose) group_close = library.symbol("H5Gclose");
  decltype(&H5Lexists) link_exists = library.symbol("H5Lexists");

  decltype(&H5Acreate_by_name) attribute_create_by_name = library.symbol("H5Acreate_by_name");
  decltype(&H5Aopen_by_name) attribute_open_by_name = library.symbol("H5Aopen_by_name");
  decltype(&H5Aexists_by_name) attribute_exists_by_name = library.symbol("H5Aexists_by_name");
  decltype(&H5Adelete_by_name) attribute_delete_by_name = library.symbol("H5Adelete_by_name");
  decltype(&H5Aread) attribute_read = library.symbol("H5Aread");
  decltype(&H5Awrite) attribute_write = library.symbol("H5Awrite");
  decltype(&H5Aclose) attribute_close = library.symbol("H5Aclose");

  decltype(&H5Dcreate2) dataset_create = library.symbol("H5Dcreate2");
  decltype(&H5Dopen2) dataset_open = library.symbol("H5Dopen2");
  decltype(&H5Dget_space) dataset_get_space = library.symbol("H5Dget_space");
  decltype(&H5Dget_type) dataset_get_type = library.symbol("H5Dget_type");
  decltype(&H5Dset_extent) dataset_set_extent = library.symbol("H5Dset_extent");
  decltype(&H5Dread) dataset_read = library.symbol("H5Dread");
  decltype(&H5Dwrite) dataset_write = library.symbol("H5Dwrite");
  decltype(&H5Dclose) dataset_close = library.symbol("H5Dclose");

  decltype(&H5Pcreate) properties_create = library.symbol("H5Pcreate");
  decltype(&H5Pset_userblock) properties_set_userblock = library.symbol("H5Pset_userblock");
  decltype(&H5Pset_chunk) properties_set_chunk = library.symbol("H5Pset_chunk");
  decltype(&H5Pset_shuffle) properties_set_shuffle = library.symbol("H5Pset_shuffle");
  decltype(&H5Pset_deflate) properties_set_deflate = library.symbol("H5Pset_deflate");
  decltype(&H5Pset_obj_track_times) properties_set_obj_track_times = library.symbol("H5Pset_obj_track_times");
  decltype(&H5Pset_create_intermediate_group) properties_set_create_intermediate_group =
      library.symbol("H5Pset_create_intermediate_group");
  decltype(&H5Pclose) properties_close = library.symbol("H5Pclose");

  decltype(&H5Screate) space_create = library.symbol("H5Screate");
  decltype(&H5Screate_simple) space_create_simple = library.symbol("H5Screate_simple");
  decltype(&H5Sget_simple_extent_npoints) space_get_simple_extent_npoints =
      library.symbol("H5Sget_simple_extent_npoints");
  decltype(&H5Sselect_hyperslab) space_select_hyperslab = library.symbol("H5Sselect_hyperslab");
  decltype(&H5Sclose) space_close = library.symbol("H5Sclose");

  decltype(&H5Tcopy) type_copy = library.symbol("H5Tcopy");
  decltype(&H5Tget_size) type_get_size = library.symbol("H5Tget_size");
  decltype(&H5Tset_size) type_set_size = library.symbol("H5Tset_size");
  decltype(&H5Tset_strpad) type_set_strpad = library.symbol("H5Tset_strpad");
  decltype(&H5Tclose) type_close = library.symbol("H5Tclose");

  // Variables in the library. H5open assigns the identifiers.
  const hid_t* native_double = library.symbol("H5T_NATIVE_DOUBLE_g");
  const hid_t* native_int64 = library.symbol("H5T_NATIVE_INT64_g");
  const hid_t* native_uint8 = library.symbol("H5T_NATIVE_UINT8_g");
  const hid_t* c_string = library.symbol("H5T_C_S1_g");
  const hid_t* file_creation = library.symbol("H5P_CLS_FILE_CREATE_ID_g");
  const hid_t* link_creation = library.symbol("H5P_CLS_LINK_CREATE_ID_g");
  const hid_t* dataset_creation = library.symbol("H5P_CLS_DATASET_CREATE_ID_g");
};

/// The library, with all identifiers assigned. Throws InputError when it cannot be loaded.
const Hdf5Calls& hdf5();

} // namespace rubato::results
