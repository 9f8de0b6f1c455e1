// SPDX-License-Identifier: LGPL-3.0-or-later
// MED lists the corners of a solid's base so that, seen from inside, they turn the other way than VTK's: the
// base is mirrored here and every node of an edge or face follows its corners. MED's mid-edge nodes come in
// the order of its edges (01 12 23 30 | top | uprights), the face nodes of HEXA27 as base, the walls on 01 12
// 23 30, top, then the body node, those of PENTA18 as the walls on 01 12 20 (MEDCoupling's CellModel).
#include "rubato/mesh/io/med_numbering.hpp"

#include <med.h>

#include <algorithm>
#include <array>
#include <utility>

namespace rubato::mesh::med {
namespace {

constexpr std::array<std::pair<CellType, int>, 19> geometries{{{CellType::point1, MED_POINT1},
                                                               {CellType::seg2, MED_SEG2},
                                                               {CellType::seg3, MED_SEG3},
                                                               {CellType::tria3, MED_TRIA3},
                                                               {CellType::tria6, MED_TRIA6},
                                                               {CellType::tria7, MED_TRIA7},
                                                               {CellType::quad4, MED_QUAD4},
                                                               {CellType::quad8, MED_QUAD8},
                                                               {CellType::quad9, MED_QUAD9},
                                                               {CellType::tetra4, MED_TETRA4},
                                                               {CellType::tetra10, MED_TETRA10},
                                                               {CellType::pyra5, MED_PYRA5},
                                                               {CellType::pyra13, MED_PYRA13},
                                                               {CellType::penta6, MED_PENTA6},
                                                               {CellType::penta15, MED_PENTA15},
                                                               {CellType::penta18, MED_PENTA18},
                                                               {CellType::hexa8, MED_HEXA8},
                                                               {CellType::hexa20, MED_HEXA20},
                                                               {CellType::hexa27, MED_HEXA27}}};

// The linear cell of a family takes the first rows of its quadratic one.
constexpr std::array<std::uint8_t, 10> tetra{0, 2, 1, 3, 6, 5, 4, 7, 9, 8};
constexpr std::array<std::uint8_t, 13> pyra{0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10};
constexpr std::array<std::uint8_t, 18> penta{0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15};
constexpr std::array<std::uint8_t, 27> hexa{0,  3,  2,  1,  4,  7,  6,  5,  11, 10, 9,  8,  15, 14,
                                            13, 12, 16, 19, 18, 17, 21, 23, 24, 22, 20, 25, 26};

std::span<const std::uint8_t> family_order(CellType type) {
  switch (type) {
  case CellType::tetra4:
  case CellType::tetra10:
    return tetra;
  case CellType::pyra5:
  case CellType::pyra13:
    return pyra;
  case CellType::penta6:
  case CellType::penta15:
  case CellType::penta18:
    return penta;
  case CellType::hexa8:
  case CellType::hexa20:
  case CellType::hexa27:
    return hexa;
  default:
    return {};
  }
}

} // namespace

int geometry_of(CellType type) {
  return std::ranges::find(geometries, type, &std::pair<CellType, int>::first)->second;
}

std::optional<CellType> type_of_geometry(int geometry) {
  const auto* const found = std::ranges::find(geometries, geometry, &std::pair<CellType, int>::second);
  if (found == geometries.end())
    return std::nullopt;
  return found->first;
}

std::span<const std::uint8_t> node_order(CellType type) {
  const auto order = family_order(type);
  return order.empty() ? order : order.first(static_cast<std::size_t>(cell::topology(type).node_count));
}

} // namespace rubato::mesh::med
