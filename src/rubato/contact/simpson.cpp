// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/simpson.hpp"

#include "rubato/cell/reference_cell.hpp"

#include <array>
#include <map>
#include <utility>

namespace rubato::contact {
namespace {

using Eigen::Vector2d;

/// On −1 … 1.
struct LinePoint {
  double xi;
  double weight;
};

std::vector<LinePoint> on_line(int parts) {
  std::vector<LinePoint> points;
  for (int i = 0; i <= 2 * parts; ++i) {
    const bool end = i == 0 || i == 2 * parts;
    const double weight = end ? 1 : i % 2 == 0 ? 2 : 4;
    points.push_back({static_cast<double>(i - parts) / parts, weight / (3 * parts)});
  }
  return points;
}

std::vector<IntegrationPoint> on_segment(int parts) {
  std::vector<IntegrationPoint> points;
  for (const auto& x : on_line(parts))
    points.push_back({{x.xi, 0}, x.weight});
  return points;
}

std::vector<IntegrationPoint> on_quadrangle(int parts) {
  std::vector<IntegrationPoint> points;
  for (const auto& y : on_line(parts))
    for (const auto& x : on_line(parts))
      points.push_back({{x.xi, y.xi}, x.weight * y.weight});
  return points;
}

/// Places in halves of a part along both edges, with the weights that the small triangles put there.
std::map<std::pair<int, int>, double> on_halves(int parts) {
  const double corner = 1.0 / (30 * parts * parts);
  std::map<std::pair<int, int>, double> weights;
  const auto add = [&](int i, int j, int side) {
    for (const auto& [a, b] : {std::pair{0, 0}, {2, 0}, {0, 2}})
      weights[{i + side * a, j + side * b}] += corner;
    for (const auto& [a, b] : {std::pair{1, 0}, {1, 1}, {0, 1}})
      weights[{i + side * a, j + side * b}] += 4 * corner;
  };
  for (int j = 0; j < parts; ++j)
    for (int i = 0; i + j < parts; ++i) {
      add(2 * i, 2 * j, 1);
      if (i + j + 1 < parts)
        add(2 * i + 2, 2 * j + 2, -1);
    }
  return weights;
}

std::vector<IntegrationPoint> on_triangle(int parts) {
  std::vector<IntegrationPoint> points;
  for (const auto& [place, weight] : on_halves(parts))
    points.push_back({Vector2d(place.first, place.second) / (2.0 * parts), weight});
  return points;
}

void mark_nodes(CellType face, std::vector<IntegrationPoint>& points) {
  constexpr double same = 1e-12;
  const auto& cell = cell::reference_cell(face);
  for (auto& point : points)
    for (int node = 0; node < cell.node_count; ++node)
      if ((cell.nodes[static_cast<std::size_t>(node)].head<2>() - point.xi).norm() < same)
        point.node = point.stands_for = node;
}

} // namespace

std::vector<IntegrationPoint> simpson_rule(CellType face, int parts) {
  const auto& topology = cell::topology(face);
  auto points = topology.dimension == 1      ? on_segment(parts)
                : topology.corner_count == 3 ? on_triangle(parts)
                                             : on_quadrangle(parts);
  mark_nodes(face, points);
  return points;
}

} // namespace rubato::contact
