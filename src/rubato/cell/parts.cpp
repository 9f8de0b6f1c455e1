// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/parts.hpp"

#include <algorithm>

namespace rubato::cell {
namespace {

struct Family {
  CellType linear;
  CellType quadratic;
  CellType full;
};

constexpr std::array<Family, 8> families{{
    {CellType::point1, CellType::point1, CellType::point1},
    {CellType::seg2, CellType::seg3, CellType::seg3},
    {CellType::tria3, CellType::tria6, CellType::tria7},
    {CellType::quad4, CellType::quad8, CellType::quad9},
    {CellType::tetra4, CellType::tetra10, CellType::tetra10},
    {CellType::pyra5, CellType::pyra13, CellType::pyra13},
    {CellType::penta6, CellType::penta15, CellType::penta18},
    {CellType::hexa8, CellType::hexa20, CellType::hexa27},
}};

const Family& family_of(CellType type) {
  return *std::ranges::find_if(families, [type](const Family& family) {
    return family.linear == type || family.quadratic == type || family.full == type;
  });
}

} // namespace

CellType linear_type(CellType type) {
  return family_of(type).linear;
}

CellType quadratic_type(CellType type) {
  return topology(type).order == 2 ? type : family_of(type).quadratic;
}

CellType full_quadratic_type(CellType type, int space_dimension) {
  const auto& family = family_of(type);
  const bool bounds_a_solid = family.linear == CellType::tria3 && space_dimension == 3;
  // PENTA18 is read and kept, but nothing is computed on it.
  if (bounds_a_solid || family.linear == CellType::penta6)
    return quadratic_type(type);
  return family.full;
}

} // namespace rubato::cell
