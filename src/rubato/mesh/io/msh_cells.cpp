// SPDX-License-Identifier: LGPL-3.0-or-later
// Gmsh numbers mid-edge nodes in its own order of edges and face nodes in its own order of faces (Gmsh
// reference manual, "MSH file format" and "Node ordering").
#include "rubato/mesh/io/msh_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace rubato::mesh::msh {
namespace {

using Order = std::span<const std::uint8_t>;

constexpr std::array<std::uint8_t, 10> tetra10{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array<std::uint8_t, 13> pyra13{0, 1, 2, 3, 4, 5, 8, 10, 6, 7, 9, 11, 12};
constexpr std::array<std::uint8_t, 18> penta18{0, 1, 2, 3, 4, 5, 6, 9, 7, 12, 14, 13, 8, 10, 11, 15, 17, 16};
constexpr std::array<std::uint8_t, 27> hexa27{0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 13, 9,  16, 18,
                                              19, 17, 10, 12, 14, 15, 22, 23, 21, 24, 20, 25, 26};

constexpr std::array<KnownType, 18> known_types{{{1, CellType::seg2, {}},
                                                 {2, CellType::tria3, {}},
                                                 {3, CellType::quad4, {}},
                                                 {4, CellType::tetra4, {}},
                                                 {5, CellType::hexa8, {}},
                                                 {6, CellType::penta6, {}},
                                                 {7, CellType::pyra5, {}},
                                                 {8, CellType::seg3, {}},
                                                 {9, CellType::tria6, {}},
                                                 {10, CellType::quad9, {}},
                                                 {11, CellType::tetra10, tetra10},
                                                 {12, CellType::hexa27, hexa27},
                                                 {13, CellType::penta18, penta18},
                                                 {15, CellType::point1, {}},
                                                 {16, CellType::quad8, {}},
                                                 {17, CellType::hexa20, Order(hexa27).first(20)},
                                                 {18, CellType::penta15, Order(penta18).first(15)},
                                                 {19, CellType::pyra13, pyra13}}};

constexpr std::string_view lower_order =
    "third order and beyond is not read; Mesh.ElementOrder = 2 makes second";
constexpr std::array<std::pair<int, std::string_view>, 9> unknown_types{
    {{14, "14-node pyramid, a full quadratic one; Mesh.SecondOrderIncomplete = 1 makes PYRA13"},
     {20, lower_order},
     {21, lower_order},
     {26, lower_order},
     {29, lower_order},
     {36, lower_order},
     {92, lower_order},
     {34, "polygon"},
     {35, "polyhedron"}}};

} // namespace

const KnownType* find_type(std::int64_t gmsh) {
  const auto* const found = std::ranges::find(known_types, gmsh, &KnownType::gmsh);
  return found == known_types.end() ? nullptr : found;
}

std::string unknown_type(std::int64_t gmsh) {
  const auto* const found = std::ranges::find(unknown_types, gmsh, &std::pair<int, std::string_view>::first);
  return found == unknown_types.end() ? fmt::format("{}", gmsh) : fmt::format("{} ({})", gmsh, found->second);
}

} // namespace rubato::mesh::msh
