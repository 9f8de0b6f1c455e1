// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/velocity_frames.hpp"

#include "rubato/contact/frozen_frame.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <utility>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// How far the obstacle comes at a point that goes on with its velocity. Along the normal it is how far its
/// surface comes where the point will be: a round one that rotates about itself comes nowhere.
Vector3d way_of(const Zone& zone, const SlavePoint& point, const Kinematics& k, const Configuration& start,
                const VectorXd& velocity, double step) {
  const auto& obstacle = *zone.obstacle;
  const double end = start.t + step;
  const Vector3d here = k.stencil.sum([&](auto node) { return start.position(node); });
  const auto there = sum_of(here, scaled(step, k.stencil.gather(velocity, *start.dofs)));
  Vector3d way = obstacle.way(here, there, start.t, end);
  if (!obstacle.rotation)
    return way;
  const auto gap_at = [&](double t) { return place_on(obstacle, obstacle.pose(t), there, point.place).gap; };
  return sum_of(way, scaled(gap_at(start.t) - gap_at(end) - dot(k.normal, way), k.normal));
}

/// What moves in a step but the bodies.
struct Moving {
  Vector3d obstacle = Vector3d::Zero(); ///< how far it comes
  double offset = 0;                    ///< how much the zone's offset opens at the point
};

/// Takes a frozen place along with the obstacle it is on, and the gap along with the offset.
void carry(Kinematics& k, const Moving& moving) {
  add_scaled(1, moving.obstacle, k.closest_point);
  k.obstacle_displacement = moving.obstacle;
  k.gap_origin -= moving.offset;
}

/// Sets from where a frozen frame counts gap and slip, so that they are those of the law of velocities.
/// `relative`: the point's velocity at the start against what it faces; `normal`: how fast the gap opens.
/// `holds`: it may not open.
void count_from(const Vector3d& relative, double normal, const Moving& moving, const VelocityLaw& law,
                double restitution, bool holds, Kinematics& k) {
  carry(k, moving);
  k.gap_origin += k.gap;
  if (law.massless)
    return;
  const double rebound = restitution * std::max(0.0, -normal);
  const double origin =
      holds ? (1 - law.theta) * normal : std::min(0.0, (1 - law.theta) * normal + law.theta * rebound);
  k.gap_origin += law.step * origin;
  for (int a = 0; a < 2; ++a)
    k.slip_origin[a] = law.step * (1 - law.theta) * dot(column_of(k.tangents, a), relative);
}

/// An open point without mass has no velocity that decides whether it closes. Its gap at the end of the step
/// decides that: it must not be negative.
void count_gap(const Moving& moving, PointEvaluation& point) {
  point.kinematics = with_frozen_frame(std::move(*point.kinematics));
  carry(*point.kinematics, moving);
}

bool gap_turns(const PointEvaluation& point) {
  return point.kinematics && !point.kinematics->stencil.turning.empty();
}

/// Takes tied points whose gap turns to the predicted middle of the step, where the law of velocities acts:
/// rows of the start would change the gap by its rotation squared.
void turn_to_middle(Discretisation& discretisation, const Configuration& start, const VectorXd& velocity,
                    double step, std::vector<PointEvaluation>& points) {
  const auto& zone = zone_of(discretisation);
  if (!zone.settings.tie || !zone.finite_rotations || std::ranges::none_of(points, gap_turns))
    return;
  const VectorXd displacement = *start.displacement + 0.5 * step * velocity;
  Configuration middle = start;
  middle.displacement = &displacement;
  std::vector<PointEvaluation> turned;
  measure(discretisation, VectorXd::Zero(zone.multiplier_count()), middle, turned);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (gap_turns(points[i]))
      points[i] = std::move(turned[i]);
}

/// Counts the gap vector of a tie from where the step starts. Rows of the middle times the displacements of
/// the step are then 0: the tie does no work, and the gap keeps its length to second order. Rows times the
/// velocity at the end would not keep it, as rows turn with every step.
void count_turning_from_start(const Configuration& start, Kinematics& k) {
  k.gap_origin = dot(k.normal, k.stencil.sum([&](auto node) { return start.position(node); }));
  k.gap = 0;
  k.slip_origin.setZero();
}

} // namespace

std::vector<PointEvaluation> velocity_frames(Discretisation& discretisation, const Configuration& start,
                                             const VectorXd& velocity, const VelocityLaw& law,
                                             std::span<double> standing,
                                             std::span<const std::uint8_t> touched) {
  const auto& zone = zone_of(discretisation);
  std::vector<PointEvaluation> points;
  measure(discretisation, VectorXd::Zero(zone.multiplier_count()), start, points);
  turn_to_middle(discretisation, start, velocity, law.step, points);
  const double end = start.t + law.step;
  Moving moving;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].kinematics)
      continue;
    const auto& k = *points[i].kinematics;
    if (zone.obstacle)
      moving.obstacle = way_of(zone, zone.points[i], k, start, velocity, law.step);
    moving.offset = zone.offset.change(zone.points[i].place, start.t, end);
    const auto relative =
        difference_of(k.stencil.gather(velocity, *start.dofs), scaled(1 / law.step, moving.obstacle));
    const double normal = dot(k.normal, relative) + moving.offset / law.step;
    const bool holds = zone.settings.tie || (!touched.empty() && touched[i] != 0);
    const bool stands = holds || k.gap <= standing[i] + tolerances.touching_gap * zone.edge();
    const bool arrives = k.gap + law.step / 2 * normal <= 0;
    if (!stands)
      standing[i] = arrives ? k.gap : 0.0;
    if (!stands && !arrives) {
      if (law.massless)
        count_gap(moving, points[i]);
      else
        points[i].kinematics.reset();
      continue;
    }
    points[i].kinematics = with_frozen_frame(std::move(*points[i].kinematics));
    if (zone.finite_rotations && gap_turns(points[i])) {
      count_turning_from_start(start, *points[i].kinematics);
      continue;
    }
    count_from(relative, normal, moving, law, zone.settings.restitution, holds, *points[i].kinematics);
  }
  return points;
}

} // namespace rubato::contact
