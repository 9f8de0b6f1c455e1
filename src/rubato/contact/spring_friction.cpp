// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/spring_friction.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <cmath>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A slip that falls to less than this part of itself in an iteration is on its way.
constexpr double falling = 0.5;

/// Since the start of the step, in space.
Vector3d slip_of(const PointEvaluation& point) {
  const auto& tangents = point.kinematics->tangents;
  const auto& slip = point.variables.slip;
  return sum_of(scaled(slip[0], column_of(tangents, 0)), scaled(slip[1], column_of(tangents, 1)));
}

/// The slip after a move, by the tangent.
Vector2d slip_after(const PointEvaluation& point, const domain::DofMap& dofs, const VectorXd& move) {
  const auto& k = *point.kinematics;
  Vector2d slip = point.variables.slip;
  for (std::size_t node = 0; node < k.stencil.nodes.size(); ++node)
    for (int c = 0; c < k.stencil.components; ++c) {
      const auto column = static_cast<Index>(node) * k.stencil.components + c;
      const double moved = move[dofs.dof(k.stencil.nodes[node], c)];
      slip[0] += k.d_slip(0, column) * moved;
      slip[1] += k.d_slip(1, column) * moved;
    }
  return slip;
}

/// One point that slips now, and what it did in the iterate before.
struct Passage {
  const PointLaw& law;
  const PointEvaluation& before;
  const PointEvaluation& now;

  bool turned() const { return dot(slip_of(before), slip_of(now)) < 0; }
  bool falls() const { return length_of(now.variables.slip) <= falling * length_of(before.variables.slip); }
  bool was_free() const { return friction_pressure(before.variables, law) == 0; }

  /// Over a slip, with the pressure that the point has now.
  bool can_pull_back(const Vector2d& slip) const {
    return law.resistance * length_of(slip) <= law.friction * friction_pressure(now.variables, law);
  }

  bool sticks_at(const Vector2d& predicted) const {
    auto point = now.variables;
    point.slip = predicted;
    return wanted_status(point, law) == Status::stick &&
           can_pull_back({now.variables.slip[0] - predicted[0], now.variables.slip[1] - predicted[1]});
  }
};

} // namespace

bool sticks_in_passing(const Zone& zone) {
  return zone.settings.friction > 0 && friction_law(zone.settings.friction_method).sticks_in_passing;
}

void stick_in_passing(const ZoneLaw& law, const IterateOfZone& before, const IterateOfZone& now,
                      const domain::DofMap& dofs, std::span<Status> status) {
  if (!sticks_in_passing(*law.zone))
    return;
  const VectorXd move = now.u - before.u;
  for (std::size_t i = 0; i < status.size(); ++i) {
    const auto was = before.status[i];
    if (status[i] != Status::slip || was == Status::open)
      continue;
    const auto point = law.of_point(i);
    const Passage passage{point, before.points[i], now.points[i]};
    const bool passes = passage.was_free() ? passage.can_pull_back(now.points[i].variables.slip)
                        : was == Status::slip
                            ? passage.turned()
                            : passage.falls() || passage.sticks_at(slip_after(before.points[i], dofs, move));
    if (passes)
      status[i] = Status::stick;
  }
}

std::vector<double> friction_stiffness(const ZoneLaw& law, std::span<const PointEvaluation> points,
                                       std::span<const Status> status) {
  std::vector<double> stiffness(points.size(), 0.0);
  const auto& friction = friction_law(law.zone->settings.friction_method);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (status[i] == Status::open)
      continue;
    stiffness[i] = std::abs(weight_of(law.zone->points[i], points[i])) *
                   friction.stiffness(points[i].variables, law.of_point(i));
  }
  return stiffness;
}

} // namespace rubato::contact
