// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/soft_springs.hpp"

#include "rubato/contact/springs.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/material/stretching.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace rubato::model {
namespace {

/// Springs of a body that have together less than this part of its stiffness are soft.
constexpr double soft_part = 1e-2;

/// What stretching is multiplied by in the stiffness of a node: the shortest edge in contact, in 2D the
/// thickness, or the way round.
double length_of(const Model& model, double edge, const Bodies& bodies, int body) {
  switch (model.study.physics) {
  case study::Physics::plane_stress:
  case study::Physics::plane_strain:
    return model.study.thickness;
  case study::Physics::axisymmetric: {
    double radius = 0;
    for (const auto node : model.dofs.nodes)
      if (bodies.of(node) == body)
        radius = std::max(radius, model.mesh.points[static_cast<std::size_t>(node)][0]);
    return 2 * std::numbers::pi * radius;
  }
  default:
    return edge;
  }
}

/// Of the softest material of each body [stress].
std::vector<double> softest(const Model& model, const Bodies& bodies) {
  std::vector<double> least(static_cast<std::size_t>(bodies.count()), INFINITY);
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
    const auto body = bodies.of(model.mesh.nodes_of(model.bulk.cells[i]).front());
    const auto law = domain::typical_law(model.mesh, model.bulk, i);
    auto& known = least[static_cast<std::size_t>(body)];
    known = std::min(known, material::stretching_stiffness(law, model.study.physics));
  }
  return least;
}

int body_of(const Model& model, const Bodies& bodies, const Spring& spring) {
  return bodies.of(model.dofs.nodes[static_cast<std::size_t>(spring.dof / model.dofs.components)]);
}

/// Of the springs of each body, along each axis [force/length].
std::vector<std::array<double, 3>> sums_of_springs(const Model& model, const Bodies& bodies) {
  std::vector<std::array<double, 3>> sums(static_cast<std::size_t>(bodies.count()), {0, 0, 0});
  for (const auto& spring : model.springs)
    if (const int body = body_of(model, bodies, spring); body >= 0)
      sums[static_cast<std::size_t>(body)][static_cast<std::size_t>(spring.dof % model.dofs.components)] +=
          spring.stiffness;
  return sums;
}

double shortest_edge(const Model& model) {
  double edge = INFINITY;
  for (const auto& zone : model.zones)
    edge = std::min(edge, zone.edge());
  return edge;
}

} // namespace

void mark_soft_springs(Model& model) {
  if (model.springs.empty() || model.zones.empty() || !std::ranges::all_of(model.zones, contact::closes_gaps))
    return;
  const Bodies bodies(model.mesh, model.bulk);
  const auto sums = sums_of_springs(model, bodies);
  const auto resistance = softest(model, bodies);
  const double edge = shortest_edge(model);
  std::vector<char> is_soft;
  for (std::size_t body = 0; body < sums.size(); ++body)
    is_soft.push_back(std::ranges::max(sums[body]) <
                      soft_part * resistance[body] * length_of(model, edge, bodies, static_cast<int>(body)));
  for (auto& spring : model.springs)
    if (const int body = body_of(model, bodies, spring); body >= 0)
      spring.soft = is_soft[static_cast<std::size_t>(body)] != 0;
}

} // namespace rubato::model
