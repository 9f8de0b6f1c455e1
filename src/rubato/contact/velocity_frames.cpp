// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/velocity_frames.hpp"

#include "rubato/contact/frozen_frame.hpp"
#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <utility>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Takes a frozen place along with the obstacle it is on.
void carry(Kinematics& k, const Vector3d& displacement) {
  k.closest_point += displacement;
  k.obstacle_displacement = displacement;
}

/// Sets from where a frozen frame counts gap and slip, so that they are those of the law of velocities.
/// `relative`: the point's velocity at the start against what it faces, which comes `displacement` in the
/// step.
void count_from(const Vector3d& relative, const Vector3d& displacement, const VelocityLaw& law,
                double restitution, Kinematics& k) {
  carry(k, displacement);
  k.gap_origin += k.gap;
  if (law.massless)
    return;
  const double normal = k.normal.dot(relative);
  const double rebound = restitution * std::max(0.0, -normal);
  k.gap_origin += law.step * std::min(0.0, (1 - law.theta) * normal + law.theta * rebound);
  k.slip_origin = law.step * (1 - law.theta) * (k.tangents.transpose() * relative);
}

} // namespace

std::vector<PointEvaluation> velocity_frames(Discretisation& discretisation, const Configuration& start,
                                             const VectorXd& velocity, const VelocityLaw& law,
                                             std::span<double> standing) {
  const auto& zone = zone_of(discretisation);
  std::vector<PointEvaluation> points;
  measure(discretisation, VectorXd::Zero(zone.multiplier_count()), start, points);
  const Vector3d displacement =
      zone.obstacle ? zone.obstacle->displacement(start.t, start.t + law.step) : Vector3d::Zero().eval();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].kinematics)
      continue;
    const auto& k = *points[i].kinematics;
    const Vector3d relative = k.stencil.gather(velocity, *start.dofs) - displacement / law.step;
    const bool stands = k.gap <= standing[i] + tolerances.touching_gap * zone.edge();
    const bool arrives = k.gap + law.step / 2 * k.normal.dot(relative) <= 0;
    if (!stands)
      standing[i] = arrives ? k.gap : 0.0;
    if (!stands && !arrives) {
      points[i].kinematics.reset();
      continue;
    }
    points[i].kinematics = with_frozen_frame(std::move(*points[i].kinematics));
    count_from(relative, displacement, law, zone.settings.restitution, *points[i].kinematics);
  }
  return points;
}

} // namespace rubato::contact
