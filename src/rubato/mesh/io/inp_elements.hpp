// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: element types of Abaqus and CalculiX as cells.
#pragma once

#include "rubato/core/cell_type.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace rubato::mesh::inp {

enum class Family {
  solid,
  plane_stress,
  plane_strain,
  axisymmetric,
  skin,       ///< without stiffness: faces that something is drawn on
  structural, ///< shells, membranes, beams, trusses, rigid faces: cells of a mesh, not of a study
  mass,
  spring,
  dashpot
};

/// How a type of element integrates its stiffness.
enum class Integration {
  full,
  incompatible, ///< with incompatible modes
  reduced       ///< at fewer points than full integration
};

/// One type of element. Corners and mid-edge nodes come in the order of the cell type.
struct ElementType {
  std::string_view name;
  Family family;
  int node_count;
  std::optional<CellType> cell;  ///< none: it becomes no cell
  std::string_view differs = {}; ///< what its formulation has that full integration has not
  Integration how = Integration::full;
};

/// By its name in any case; nullptr when there is none.
const ElementType* element_type_named(std::string_view name);
std::string nearest_element_type(std::string_view name);
std::span<const ElementType> all_element_types();

/// The type as a surface without stiffness.
const ElementType* as_skin(const ElementType& type);

/// Whether cells of the family deform.
constexpr bool is_continuum(Family family) {
  return family <= Family::axisymmetric;
}

/// The side of a cell (cell/topology.hpp) that is face `number`, from 1; nothing when it has none.
std::optional<int> side_of_face(CellType type, int number);

} // namespace rubato::mesh::inp
