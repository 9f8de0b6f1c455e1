// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/integration.hpp"

#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/simpson.hpp"
#include "rubato/study/contact_methods.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

namespace rubato::contact {
namespace {

using Eigen::Vector2d;

IntegrationPoint on_node(int node, const Vector2d& xi, double weight) {
  return {xi, weight, node, node};
}

std::vector<IntegrationPoint> quadrangle_nodes(bool with_centre) {
  static const std::array<Vector2d, 9> places{Vector2d(-1, -1), Vector2d(1, -1), Vector2d(1, 1),
                                              Vector2d(-1, 1),  Vector2d(0, -1), Vector2d(1, 0),
                                              Vector2d(0, 1),   Vector2d(-1, 0), Vector2d(0, 0)};
  std::vector<IntegrationPoint> points;
  points.reserve(places.size());
  for (int i = 0; i < 9; ++i) {
    const double weight = i < 4 ? 1.0 / 9 : i < 8 ? 4.0 / 9 : 16.0 / 9;
    points.push_back(on_node(i, places[static_cast<std::size_t>(i)], weight));
  }
  if (!with_centre)
    points.back().node = points.back().stands_for = -1;
  return points;
}

/// The rule of degree 4, whose order of points is Code_Aster's.
std::vector<IntegrationPoint> triangle_six_points(CellType face) {
  auto points = gauss_rule(face, 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i].stands_for = static_cast<int>(i);
  return points;
}

/// Integrals of the shape functions.
Eigen::VectorXd shares(CellType face, const std::vector<IntegrationPoint>& points) {
  const auto& cell = cell::reference_cell(face);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(cell.node_count);
  std::array<double, 9> values{};
  for (const auto& point : points) {
    cell.values({point.xi[0], point.xi[1], 0},
                std::span(values).first(static_cast<std::size_t>(cell.node_count)));
    for (int i = 0; i < cell.node_count; ++i)
      sum[i] += point.weight * values[static_cast<std::size_t>(i)];
  }
  return sum;
}

/// Whether it integrates the shape functions, which four Gauss points a direction do.
bool is_exact(CellType face, const std::vector<IntegrationPoint>& points) {
  constexpr double rounding = 1e-12;
  return (shares(face, points) - shares(face, gauss_rule(face, 4))).lpNorm<Eigen::Infinity>() < rounding;
}

std::vector<IntegrationPoint> on_nodes(CellType face, int /*order*/) {
  return nodal_rule(face);
}

std::vector<IntegrationPoint> one_a_node(CellType face, int /*order*/) {
  return node_rule(face);
}

/// In the order of the rules.
constexpr std::array<Integration, 4> integrations{{
    {study::ContactIntegration::nodes, &on_nodes, true, false},
    {study::ContactIntegration::gauss, &gauss_rule, false, false},
    {study::ContactIntegration::simpson, &simpson_rule, false, false},
    {study::ContactIntegration::mortar, nullptr, false, false},
}};

} // namespace

const Integration& integration(study::ContactIntegration by) {
  return integrations[static_cast<std::size_t>(by)];
}

Integration integration_of(const study::ContactZone& settings) {
  const auto by = settings.integration.by;
  return study::entry_of(settings.method).nodal ? Integration{by, &one_a_node, true, true} : integration(by);
}

std::optional<int> least_order(study::ContactIntegration by, CellType face) {
  if (integration(by).points == nullptr)
    return 0;
  const int most = study::entry_of(by).most_order;
  const auto nodes = static_cast<std::size_t>(cell::topology(face).node_count);
  for (int order = std::min(1, most); order <= most; ++order) {
    const auto points = integration(by).points(face, order);
    if (is_exact(face, points) && (points.size() >= nodes || most == 0))
      return order;
  }
  return std::nullopt;
}

std::vector<IntegrationPoint> nodal_rule(CellType face) {
  switch (face) {
  case CellType::seg2:
    return {on_node(0, {-1, 0}, 1), on_node(1, {1, 0}, 1)};
  case CellType::seg3:
    return {on_node(0, {-1, 0}, 1.0 / 3), on_node(1, {1, 0}, 1.0 / 3), on_node(2, {0, 0}, 4.0 / 3)};
  case CellType::tria3:
    return {on_node(0, {0, 0}, 1.0 / 6), on_node(1, {1, 0}, 1.0 / 6), on_node(2, {0, 1}, 1.0 / 6)};
  case CellType::quad4:
    return {on_node(0, {-1, -1}, 1), on_node(1, {1, -1}, 1), on_node(2, {1, 1}, 1), on_node(3, {-1, 1}, 1)};
  case CellType::quad8:
    return quadrangle_nodes(false);
  case CellType::quad9:
    return quadrangle_nodes(true);
  case CellType::tria6:
  case CellType::tria7:
    return triangle_six_points(face);
  default:
    throw std::invalid_argument("contact faces are segments, triangles and quadrangles");
  }
}

std::vector<IntegrationPoint> gauss_rule(CellType face, int order) {
  std::vector<IntegrationPoint> points;
  for (const auto& [xi, weight] : cell::gauss_rule(face, order))
    points.push_back({xi.head<2>(), weight, -1, -1});
  return points;
}

std::vector<IntegrationPoint> node_rule(CellType face) {
  auto points = nodal_rule(face);
  if (std::ranges::all_of(points, [](const auto& point) { return point.node >= 0; }))
    return points;
  double measure = 0;
  for (const auto& point : points)
    measure += point.weight;
  const auto& cell = cell::reference_cell(face);
  points.clear();
  for (int i = 0; i < cell.node_count; ++i)
    points.push_back(
        on_node(i, cell.nodes[static_cast<std::size_t>(i)].head<2>(), measure / cell.node_count));
  return points;
}

} // namespace rubato::contact
