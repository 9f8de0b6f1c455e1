// SPDX-License-Identifier: LGPL-3.0-or-later
// Code_Aster's corners are ours (MED's are mirrored). Its mid-edge nodes of prisms and hexahedra come as
// base, uprights, top; the face nodes of HEXA27 as base, η=−1, ξ=+1, η=+1, ξ=−1, top (Code_Aster
// documentation R3.01.01, "Volumic elements").
#include "rubato/mesh/io/mail_cells.hpp"

#include <algorithm>
#include <array>

namespace rubato::mesh::mail {
namespace {

using Order = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 18> penta{0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11, 15, 16, 17};
constexpr std::array<std::uint8_t, 27> hexa{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 16, 17,
                                            18, 19, 12, 13, 14, 15, 24, 22, 21, 23, 20, 25, 26};

constexpr std::array<KnownType, 19> known_types{{{"POI1", CellType::point1, {}},
                                                 {"SEG2", CellType::seg2, {}},
                                                 {"SEG3", CellType::seg3, {}},
                                                 {"TRIA3", CellType::tria3, {}},
                                                 {"TRIA6", CellType::tria6, {}},
                                                 {"TRIA7", CellType::tria7, {}},
                                                 {"QUAD4", CellType::quad4, {}},
                                                 {"QUAD8", CellType::quad8, {}},
                                                 {"QUAD9", CellType::quad9, {}},
                                                 {"TETRA4", CellType::tetra4, {}},
                                                 {"TETRA10", CellType::tetra10, {}},
                                                 {"PYRAM5", CellType::pyra5, {}},
                                                 {"PYRAM13", CellType::pyra13, {}},
                                                 {"PENTA6", CellType::penta6, {}},
                                                 {"PENTA15", CellType::penta15, Order(penta).first(15)},
                                                 {"PENTA18", CellType::penta18, penta},
                                                 {"HEXA8", CellType::hexa8, {}},
                                                 {"HEXA20", CellType::hexa20, Order(hexa).first(20)},
                                                 {"HEXA27", CellType::hexa27, hexa}}};

} // namespace

std::span<const KnownType> all_types() {
  return known_types;
}

const KnownType* type_named(std::string_view name) {
  const auto* const found = std::ranges::find(known_types, name, &KnownType::name);
  return found == known_types.end() ? nullptr : found;
}

} // namespace rubato::mesh::mail
