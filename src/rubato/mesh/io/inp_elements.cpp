// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/inp_elements.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/transformed.hpp"
#include "rubato/mesh/io/inp_keywords.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace rubato::mesh::inp {
namespace {

constexpr std::string_view reduced = "reduced integration";
constexpr std::string_view two_points = "two points of integration";
constexpr std::string_view nine_points = "nine points of integration";
constexpr std::string_view averaged = "averaged volume strain";
constexpr std::string_view incompatible = "incompatible modes";
constexpr std::string_view modified = "a modified formulation";

constexpr std::array types{
    ElementType{"C3D4", Family::solid, 4, CellType::tetra4},
    ElementType{"C3D10", Family::solid, 10, CellType::tetra10},
    ElementType{"C3D10I", Family::solid, 10, CellType::tetra10, modified},
    ElementType{"C3D10M", Family::solid, 10, CellType::tetra10, modified},
    ElementType{"C3D10T", Family::solid, 10, CellType::tetra10, modified},
    ElementType{"C3D5", Family::solid, 5, CellType::pyra5},
    ElementType{"C3D6", Family::solid, 6, CellType::penta6, two_points, Integration::reduced},
    ElementType{"C3D15", Family::solid, 15, CellType::penta15, nine_points, Integration::reduced},
    ElementType{"C3D8", Family::solid, 8, CellType::hexa8, averaged},
    ElementType{"C3D8R", Family::solid, 8, CellType::hexa8, reduced, Integration::reduced},
    ElementType{"C3D8I", Family::solid, 8, CellType::hexa8, incompatible, Integration::incompatible},
    ElementType{"C3D20", Family::solid, 20, CellType::hexa20},
    ElementType{"C3D20R", Family::solid, 20, CellType::hexa20, reduced, Integration::reduced},
    ElementType{"C3D27", Family::solid, 27, CellType::hexa27},
    ElementType{"C3D27R", Family::solid, 27, CellType::hexa27, reduced, Integration::reduced},
    ElementType{"CPS3", Family::plane_stress, 3, CellType::tria3},
    ElementType{"CPS4", Family::plane_stress, 4, CellType::quad4},
    ElementType{"CPS4R", Family::plane_stress, 4, CellType::quad4, reduced, Integration::reduced},
    ElementType{"CPS4I", Family::plane_stress, 4, CellType::quad4, incompatible, Integration::incompatible},
    ElementType{"CPS6", Family::plane_stress, 6, CellType::tria6},
    ElementType{"CPS6M", Family::plane_stress, 6, CellType::tria6, modified},
    ElementType{"CPS8", Family::plane_stress, 8, CellType::quad8},
    ElementType{"CPS8R", Family::plane_stress, 8, CellType::quad8, reduced, Integration::reduced},
    ElementType{"CPE3", Family::plane_strain, 3, CellType::tria3},
    ElementType{"CPE4", Family::plane_strain, 4, CellType::quad4, averaged},
    ElementType{"CPE4R", Family::plane_strain, 4, CellType::quad4, reduced, Integration::reduced},
    ElementType{"CPE4I", Family::plane_strain, 4, CellType::quad4, incompatible, Integration::incompatible},
    ElementType{"CPE6", Family::plane_strain, 6, CellType::tria6},
    ElementType{"CPE6M", Family::plane_strain, 6, CellType::tria6, modified},
    ElementType{"CPE8", Family::plane_strain, 8, CellType::quad8},
    ElementType{"CPE8R", Family::plane_strain, 8, CellType::quad8, reduced, Integration::reduced},
    ElementType{"CAX3", Family::axisymmetric, 3, CellType::tria3},
    ElementType{"CAX4", Family::axisymmetric, 4, CellType::quad4, averaged},
    ElementType{"CAX4R", Family::axisymmetric, 4, CellType::quad4, reduced, Integration::reduced},
    ElementType{"CAX4I", Family::axisymmetric, 4, CellType::quad4, incompatible, Integration::incompatible},
    ElementType{"CAX6", Family::axisymmetric, 6, CellType::tria6},
    ElementType{"CAX6M", Family::axisymmetric, 6, CellType::tria6, modified},
    ElementType{"CAX8", Family::axisymmetric, 8, CellType::quad8},
    ElementType{"CAX8R", Family::axisymmetric, 8, CellType::quad8, reduced, Integration::reduced},
    ElementType{"SFM3D3", Family::skin, 3, CellType::tria3},
    ElementType{"SFM3D4", Family::skin, 4, CellType::quad4},
    ElementType{"SFM3D4R", Family::skin, 4, CellType::quad4},
    ElementType{"SFM3D6", Family::skin, 6, CellType::tria6},
    ElementType{"SFM3D8", Family::skin, 8, CellType::quad8},
    ElementType{"SFM3D8R", Family::skin, 8, CellType::quad8},
    ElementType{"S3", Family::structural, 3, CellType::tria3},
    ElementType{"S3R", Family::structural, 3, CellType::tria3},
    ElementType{"S4", Family::structural, 4, CellType::quad4},
    ElementType{"S4R", Family::structural, 4, CellType::quad4},
    ElementType{"S6", Family::structural, 6, CellType::tria6},
    ElementType{"S8", Family::structural, 8, CellType::quad8},
    ElementType{"S8R", Family::structural, 8, CellType::quad8},
    ElementType{"STRI3", Family::structural, 3, CellType::tria3},
    ElementType{"STRI65", Family::structural, 6, CellType::tria6},
    ElementType{"M3D3", Family::structural, 3, CellType::tria3},
    ElementType{"M3D4", Family::structural, 4, CellType::quad4},
    ElementType{"M3D4R", Family::structural, 4, CellType::quad4},
    ElementType{"M3D6", Family::structural, 6, CellType::tria6},
    ElementType{"M3D8", Family::structural, 8, CellType::quad8},
    ElementType{"M3D8R", Family::structural, 8, CellType::quad8},
    ElementType{"R3D3", Family::structural, 3, CellType::tria3},
    ElementType{"R3D4", Family::structural, 4, CellType::quad4},
    ElementType{"R2D2", Family::structural, 2, CellType::seg2},
    ElementType{"RAX2", Family::structural, 2, CellType::seg2},
    ElementType{"T2D2", Family::structural, 2, CellType::seg2},
    ElementType{"T3D2", Family::structural, 2, CellType::seg2},
    ElementType{"T3D3", Family::structural, 3, CellType::seg3},
    ElementType{"B21", Family::structural, 2, CellType::seg2},
    ElementType{"B31", Family::structural, 2, CellType::seg2},
    ElementType{"B31R", Family::structural, 2, CellType::seg2},
    ElementType{"B32", Family::structural, 3, CellType::seg3},
    ElementType{"B32R", Family::structural, 3, CellType::seg3},
    ElementType{"MASS", Family::mass, 1, CellType::point1},
    ElementType{"SPRING1", Family::spring, 1, std::nullopt},
    ElementType{"SPRING2", Family::spring, 2, std::nullopt},
    ElementType{"SPRINGA", Family::spring, 2, std::nullopt},
    ElementType{"GAPUNI", Family::spring, 2, std::nullopt},
    ElementType{"DASHPOT1", Family::dashpot, 1, std::nullopt},
    ElementType{"DASHPOT2", Family::dashpot, 2, std::nullopt},
    ElementType{"DASHPOTA", Family::dashpot, 2, std::nullopt},
};

/// Faces 1 to 6 of hexahedra are ζ−, ζ+, η−, ξ+, η+, ξ−.
constexpr std::array<int, 6> hexa_sides{4, 5, 2, 1, 3, 0};

} // namespace

const ElementType* element_type_named(std::string_view name) {
  const auto wanted = folded(name);
  const auto* const found = std::ranges::find(types, std::string_view(wanted), &ElementType::name);
  return found == types.end() ? nullptr : found;
}

const ElementType* as_skin(const ElementType& type) {
  static const auto skins = [] {
    auto all = types;
    for (auto& row : all)
      row.family = Family::skin;
    return all;
  }();
  return &skins.at(static_cast<std::size_t>(&type - types.data()));
}

std::string nearest_element_type(std::string_view name) {
  const auto names = transformed<std::string>(types, &ElementType::name);
  return nearest_word(std::string(name.substr(0, 30)), names);
}

std::span<const ElementType> all_element_types() {
  return types;
}

std::optional<int> side_of_face(CellType type, int number) {
  const auto count = static_cast<int>(cell::topology(type).sides.size());
  if (number < 1 || number > count)
    return std::nullopt;
  const bool is_hexa = count == static_cast<int>(hexa_sides.size());
  return is_hexa ? hexa_sides.at(static_cast<std::size_t>(number) - 1) : number - 1;
}

} // namespace rubato::mesh::inp
