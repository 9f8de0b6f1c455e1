// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/topology.hpp"

#include <algorithm>
#include <cctype>
#include <string>

namespace rubato::cell {
namespace {

using U8 = std::uint8_t;
using Edge = std::array<U8, 2>;

constexpr std::array<Edge, 1> seg_edges{{{0, 1}}};
constexpr std::array<Edge, 3> tria_edges{{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<Edge, 4> quad_edges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr std::array<Edge, 6> tetra_edges{{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
constexpr std::array<Edge, 8> pyra_edges{{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}};
constexpr std::array<Edge, 9> penta_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
constexpr std::array<Edge, 12> hexa_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

// Sides as node tables: corners, mid-edge nodes, centre. The linear, quadratic and full cells of a family
// share them: each takes as many nodes of a row as its own side type has.
template <std::size_t N> using Row = std::array<U8, N>;

constexpr std::array<Row<3>, 3> tria_sides{{{0, 1, 3}, {1, 2, 4}, {2, 0, 5}}};
constexpr std::array<Row<3>, 4> quad_sides{{{0, 1, 4}, {1, 2, 5}, {2, 3, 6}, {3, 0, 7}}};
constexpr std::array<Row<6>, 4> tetra_sides{
    {{0, 2, 1, 6, 5, 4}, {0, 1, 3, 4, 8, 7}, {1, 2, 3, 5, 9, 8}, {2, 0, 3, 6, 7, 9}}};
constexpr Row<8> pyra_base{0, 3, 2, 1, 8, 7, 6, 5};
constexpr std::array<Row<6>, 4> pyra_sides{
    {{0, 1, 4, 5, 10, 9}, {1, 2, 4, 6, 11, 10}, {2, 3, 4, 7, 12, 11}, {3, 0, 4, 8, 9, 12}}};
constexpr std::array<Row<6>, 2> penta_ends{{{0, 2, 1, 8, 7, 6}, {3, 4, 5, 9, 10, 11}}};
constexpr std::array<Row<9>, 3> penta_sides{
    {{0, 1, 4, 3, 6, 13, 9, 12, 15}, {1, 2, 5, 4, 7, 14, 10, 13, 16}, {2, 0, 3, 5, 8, 12, 11, 14, 17}}};
constexpr std::array<Row<9>, 6> hexa_sides{{{0, 4, 7, 3, 16, 15, 19, 11, 20},
                                            {1, 2, 6, 5, 9, 18, 13, 17, 21},
                                            {0, 1, 5, 4, 8, 17, 12, 16, 22},
                                            {2, 3, 7, 6, 10, 19, 14, 18, 23},
                                            {0, 3, 2, 1, 11, 10, 9, 8, 24},
                                            {4, 5, 6, 7, 12, 13, 14, 15, 25}}};

template <std::size_t Count, std::size_t Width>
constexpr std::array<CellSide, Count> sides_of(const std::array<Row<Width>, Count>& rows, CellType type,
                                               std::size_t node_count) {
  std::array<CellSide, Count> sides{};
  for (std::size_t i = 0; i < Count; ++i)
    sides[i] = {type, std::span<const U8>(rows[i].data(), node_count)};
  return sides;
}

constexpr auto tria_sides2 = sides_of(tria_sides, CellType::seg2, 2);
constexpr auto tria_sides3 = sides_of(tria_sides, CellType::seg3, 3);
constexpr auto quad_sides2 = sides_of(quad_sides, CellType::seg2, 2);
constexpr auto quad_sides3 = sides_of(quad_sides, CellType::seg3, 3);
constexpr auto tetra_sides3 = sides_of(tetra_sides, CellType::tria3, 3);
constexpr auto tetra_sides6 = sides_of(tetra_sides, CellType::tria6, 6);
constexpr auto hexa_sides4 = sides_of(hexa_sides, CellType::quad4, 4);
constexpr auto hexa_sides8 = sides_of(hexa_sides, CellType::quad8, 8);
constexpr auto hexa_sides9 = sides_of(hexa_sides, CellType::quad9, 9);

constexpr std::array<CellSide, 5> pyramid_sides(CellType base, std::size_t base_nodes, CellType wall,
                                                std::size_t wall_nodes) {
  const auto walls = sides_of(pyra_sides, wall, wall_nodes);
  return {CellSide{base, std::span<const U8>(pyra_base.data(), base_nodes)}, walls[0], walls[1], walls[2],
          walls[3]};
}
constexpr auto pyra5_sides = pyramid_sides(CellType::quad4, 4, CellType::tria3, 3);
constexpr auto pyra13_sides = pyramid_sides(CellType::quad8, 8, CellType::tria6, 6);

constexpr std::array<CellSide, 5> prism_sides(CellType end, std::size_t end_nodes, CellType wall,
                                              std::size_t wall_nodes) {
  const auto ends = sides_of(penta_ends, end, end_nodes);
  const auto walls = sides_of(penta_sides, wall, wall_nodes);
  return {ends[0], ends[1], walls[0], walls[1], walls[2]};
}
constexpr auto penta6_sides = prism_sides(CellType::tria3, 3, CellType::quad4, 4);
constexpr auto penta15_sides = prism_sides(CellType::tria6, 6, CellType::quad8, 8);
constexpr auto penta18_sides = prism_sides(CellType::tria6, 6, CellType::quad9, 9);

constexpr std::array<CellTopology, 19> topologies{{
    {CellType::point1, "POINT1", 0, 1, 1, 1, {}, {}},
    {CellType::seg2, "SEG2", 1, 1, 2, 2, {}, seg_edges},
    {CellType::seg3, "SEG3", 1, 2, 3, 2, {}, seg_edges},
    {CellType::tria3, "TRIA3", 2, 1, 3, 3, tria_sides2, tria_edges},
    {CellType::tria6, "TRIA6", 2, 2, 6, 3, tria_sides3, tria_edges},
    {CellType::tria7, "TRIA7", 2, 2, 7, 3, tria_sides3, tria_edges},
    {CellType::quad4, "QUAD4", 2, 1, 4, 4, quad_sides2, quad_edges},
    {CellType::quad8, "QUAD8", 2, 2, 8, 4, quad_sides3, quad_edges},
    {CellType::quad9, "QUAD9", 2, 2, 9, 4, quad_sides3, quad_edges},
    {CellType::tetra4, "TETRA4", 3, 1, 4, 4, tetra_sides3, tetra_edges},
    {CellType::tetra10, "TETRA10", 3, 2, 10, 4, tetra_sides6, tetra_edges},
    {CellType::pyra5, "PYRA5", 3, 1, 5, 5, pyra5_sides, pyra_edges},
    {CellType::pyra13, "PYRA13", 3, 2, 13, 5, pyra13_sides, pyra_edges},
    {CellType::penta6, "PENTA6", 3, 1, 6, 6, penta6_sides, penta_edges},
    {CellType::penta15, "PENTA15", 3, 2, 15, 6, penta15_sides, penta_edges},
    {CellType::penta18, "PENTA18", 3, 2, 18, 6, penta18_sides, penta_edges},
    {CellType::hexa8, "HEXA8", 3, 1, 8, 8, hexa_sides4, hexa_edges},
    {CellType::hexa20, "HEXA20", 3, 2, 20, 8, hexa_sides8, hexa_edges},
    {CellType::hexa27, "HEXA27", 3, 2, 27, 8, hexa_sides9, hexa_edges},
}};

} // namespace

const CellTopology& topology(CellType type) {
  return topologies[static_cast<std::size_t>(type)];
}

std::span<const CellTopology> all_topologies() {
  return topologies;
}

std::optional<CellType> cell_type_named(std::string_view name) {
  std::string upper(name);
  std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return std::toupper(c); });
  const auto found = std::ranges::find(topologies, upper, &CellTopology::name);
  if (found == topologies.end())
    return std::nullopt;
  return found->type;
}

} // namespace rubato::cell
