// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/subfacets.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/topology.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::contact::mortar {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

using Nodes = std::vector<std::uint8_t>;

/// ξ of a local node; QUAD8 has a node 8 at (0, 0) for clipping.
Vector2d place_of(CellType face, std::uint8_t node) {
  const auto& cell = cell::reference_cell(face);
  return node < cell.node_count ? Vector2d(cell.nodes[node].head<2>()) : Vector2d(0, 0);
}

/// The affine map from the facet's own reference cell: SEG2 [−1, 1], TRIA3, QUAD4 [−1, 1]².
SubFacet make_facet(CellType face, const Nodes& nodes) {
  SubFacet facet;
  facet.node_count = static_cast<int>(nodes.size());
  std::ranges::copy(nodes, facet.nodes.begin());
  std::array<Vector2d, 4> at;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    at[i] = place_of(face, nodes[i]);
    facet.middle += at[i] / static_cast<double>(nodes.size());
  }
  facet.origin = facet.middle;
  facet.from_local.setIdentity();
  if (facet.node_count == 2) {
    facet.from_local(0, 0) = 0.5 * (at[1] - at[0])[0];
  } else if (facet.node_count == 3) {
    facet.origin = at[0];
    facet.from_local << at[1] - at[0], at[2] - at[0];
  } else {
    facet.from_local << 0.5 * (at[1] - at[0]), 0.5 * (at[3] - at[0]);
  }
  facet.to_local = facet.from_local.inverse();
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
  const auto found = std::ranges::find(table, face, &Entry::face);
  if (found == table.end())
    throw std::invalid_argument("no mortar contact on cells of type " +
                                std::string(cell::topology(face).name));
  return *found;
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
  const Vector2d r = facet.to_local * (xi - facet.origin);
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
  const double scale = facet.from_local.determinant();
  for (auto& point : rule) {
    point.xi.head<2>() = facet.origin + facet.from_local * point.xi.head<2>();
    point.weight *= scale;
  }
  return rule;
}

} // namespace rubato::contact::mortar
