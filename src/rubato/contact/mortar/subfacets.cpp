// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/subfacets.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/topology.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector2d;

using Nodes = std::vector<std::uint8_t>;

/// ξ of a local node; QUAD8 has a node 8 at (0, 0) for clipping.
Vector2d place_of(CellType face, std::uint8_t node) {
  const auto& cell = cell::reference_cell(face);
  return node < cell.node_count ? Vector2d(cell.nodes[node][0], cell.nodes[node][1]) : Vector2d(0, 0);
}

/// The affine map from the facet's own reference cell: SEG2 [−1, 1], TRIA3, QUAD4 [−1, 1]².
SubFacet make_facet(CellType face, const Nodes& nodes) {
  SubFacet facet;
  facet.node_count = static_cast<int>(nodes.size());
  std::copy(nodes.begin(), nodes.end(), facet.nodes.begin());
  std::array<Vector2d, 4> at;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    at[i] = place_of(face, nodes[i]);
    for (int a = 0; a < 2; ++a)
      facet.middle[a] += at[i][a] / static_cast<double>(nodes.size());
  }
  facet.origin = facet.node_count == 3 ? at[0] : facet.middle;
  const double scale = facet.node_count == 3 ? 1 : 0.5;
  for (int a = 0; a < 2 && facet.node_count > 2; ++a) {
    facet.from_local(a, 0) = scale * (at[1][a] - at[0][a]);
    facet.from_local(a, 1) = scale * (at[facet.node_count == 3 ? 2 : 3][a] - at[0][a]);
  }
  if (facet.node_count == 2)
    facet.from_local(0, 0) = scale * (at[1][0] - at[0][0]);
  const double inverse = 1 / facet.stretch();
  facet.to_local(0, 0) = facet.from_local(1, 1) * inverse;
  facet.to_local(1, 0) = -facet.from_local(1, 0) * inverse;
  facet.to_local(0, 1) = -facet.from_local(0, 1) * inverse;
  facet.to_local(1, 1) = facet.from_local(0, 0) * inverse;
  return facet;
}

std::vector<SubFacet> make_facets(CellType face, const std::vector<Nodes>& parts) {
  std::vector<SubFacet> facets;
  facets.reserve(parts.size());
  for (const auto& nodes : parts)
    facets.push_back(make_facet(face, nodes));
  return facets;
}

const std::vector<Nodes> triangle_of_six{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
const std::vector<Nodes> square_of_nine{{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}};

struct Entry {
  CellType face;
  std::vector<SubFacet> multipliers;
  std::vector<SubFacet> clipping;
};

std::vector<Entry> make_table() {
  const auto row = [](CellType face, const std::vector<Nodes>& parts, const std::vector<Nodes>& clipping) {
    return Entry{face, make_facets(face, parts), make_facets(face, clipping)};
  };
  const std::vector<Nodes> segment{{0, 1}}, halves{{0, 2}, {2, 1}}, triangle{{0, 1, 2}}, square{{0, 1, 2, 3}};
  const std::vector<Nodes> around_centre{{0, 3, 6}, {3, 1, 6}, {1, 4, 6}, {4, 2, 6}, {2, 5, 6}, {5, 0, 6}};
  const std::vector<Nodes> corners_and_square{{0, 4, 7}, {1, 5, 4}, {2, 6, 5}, {3, 7, 6}, {4, 5, 6, 7}};
  return {row(CellType::seg2, segment, segment),
          row(CellType::seg3, halves, halves),
          row(CellType::tria3, triangle, triangle),
          row(CellType::tria6, triangle_of_six, triangle_of_six),
          row(CellType::tria7, around_centre, triangle_of_six),
          row(CellType::quad4, square, square),
          row(CellType::quad8, corners_and_square, square_of_nine),
          row(CellType::quad9, square_of_nine, square_of_nine)};
}

const Entry& entry_of(CellType face) {
  static const auto table = make_table();
  for (const auto& entry : table)
    if (entry.face == face)
      return entry;
  throw std::invalid_argument("no mortar contact on cells of type " + std::string(cell::topology(face).name));
}

} // namespace

CellType SubFacet::type() const {
  return node_count == 2 ? CellType::seg2 : node_count == 3 ? CellType::tria3 : CellType::quad4;
}

std::span<const SubFacet> subfacets(CellType face) {
  return entry_of(face).multipliers;
}

std::span<const SubFacet> clipping_facets(CellType face) {
  return entry_of(face).clipping;
}

Eigen::Vector4d facet_values(const SubFacet& facet, const Vector2d& xi) {
  const double first = xi[0] - facet.origin[0], second = xi[1] - facet.origin[1];
  const Vector2d r(facet.to_local(0, 0) * first + facet.to_local(0, 1) * second,
                   facet.to_local(1, 0) * first + facet.to_local(1, 1) * second);
  if (facet.node_count == 2)
    return {0.5 * (1 - r[0]), 0.5 * (1 + r[0]), 0, 0};
  if (facet.node_count == 3)
    return {1 - r[0] - r[1], r[0], r[1], 0};
  const double left = 0.5 * (1 - r[0]), right = 0.5 * (1 + r[0]);
  const double below = 0.5 * (1 - r[1]), above = 0.5 * (1 + r[1]);
  return {left * below, right * below, right * above, left * above};
}

std::vector<cell::QuadraturePoint> facet_rule(const SubFacet& facet, int degree) {
  auto rule = cell::rule_of_degree(facet.type(), degree);
  for (auto& point : rule) {
    const auto xi = facet.to_face({point.xi[0], point.xi[1]});
    point.xi[0] = xi[0];
    point.xi[1] = xi[1];
    point.weight *= facet.stretch();
  }
  return rule;
}

} // namespace rubato::contact::mortar
