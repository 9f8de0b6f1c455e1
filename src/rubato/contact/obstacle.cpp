// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/obstacle.hpp"

#include "rubato/core/function.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace rubato::contact {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using study::ObstacleKind;

/// Distance from the middle, in radii, where a direction is rounding only; and how near to −1 the cosine of a
/// turn may come before its axis is.
constexpr double no_direction = 1e-12;

/// A unit vector across a unit vector: e_z × n in 2D, so that τ₂ = e_z.
Vector3d across(const Vector3d& n) {
  int axis = 2;
  for (const int other : {1, 0})
    if (std::abs(n[other]) < std::abs(n[axis]))
      axis = other;
  return Vector3d::Unit(axis).cross(n).normalized();
}

Vector3d vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Distance and normal from the part of r that points away from a middle; `away` projects on such parts.
PlaceOnObstacle round_place(const Obstacle& obstacle, const Vector3d& r, const Matrix3d& away) {
  const Vector3d part = away * r;
  const double distance = part.norm();
  PlaceOnObstacle place;
  place.gap = obstacle.sign * (distance - obstacle.radius);
  if (distance <= no_direction * obstacle.radius) {
    place.normal = obstacle.sign * across(obstacle.direction);
    return place;
  }
  const Vector3d e = part / distance;
  place.normal = obstacle.sign * e;
  place.curvature = obstacle.sign / distance * (away - e * e.transpose());
  return place;
}

PlaceOnObstacle place_on_plane(const Obstacle& obstacle, const Matrix3d& turn, const Vector3d& r,
                               const Vector3d& /*reference*/) {
  PlaceOnObstacle place;
  place.normal = turn * obstacle.direction;
  place.gap = place.normal.dot(r);
  place.tangent = turn * across(obstacle.direction);
  return place;
}

PlaceOnObstacle place_on_cylinder(const Obstacle& obstacle, const Matrix3d& turn, const Vector3d& r,
                                  const Vector3d& /*reference*/) {
  const Vector3d axis = turn * obstacle.direction;
  auto place = round_place(obstacle, r, Matrix3d::Identity() - axis * axis.transpose());
  place.tangent = axis.cross(place.normal);
  return place;
}

/// The least turn from n₀ to n takes a vector t ⊥ n₀ to t − (t·n)(n₀ + n)/(1 + n₀·n).
PlaceOnObstacle place_on_sphere(const Obstacle& obstacle, const Matrix3d& /*turn*/, const Vector3d& r,
                                const Vector3d& reference) {
  auto place = round_place(obstacle, r, Matrix3d::Identity());
  const Vector3d start = round_place(obstacle, reference, Matrix3d::Identity()).normal;
  const Vector3d tangent = across(start);
  const double turn = 1 + start.dot(place.normal);
  if (turn <= no_direction) { // the opposite place: every great circle leads there
    place.tangent = (tangent - tangent.dot(place.normal) * place.normal).normalized();
    return place;
  }
  place.tangent = tangent - tangent.dot(place.normal) / turn * (start + place.normal);
  place.spin = place.normal.cross(start) / turn;
  return place;
}

/// ½ (R − 1) and ½ (1 − Rᵀ), R the turn between two instants.
struct HalfTurns {
  HalfTurns(const constraint::Rotation& rotation, double from, double to) {
    const double angle = constraint::angle_at(rotation, to) - constraint::angle_at(rotation, from);
    const double half = std::sin(angle / 2); // 1 − cos θ = 2 sin²(θ/2), which keeps its digits
    Matrix3d once;
    for (int i = 0; i < 3; ++i)
      once.col(i) = rotation.axis.cross(Vector3d::Unit(i));
    const Matrix3d twice = once * once;
    forth = 0.5 * std::sin(angle) * once + half * half * twice;
    back = 0.5 * std::sin(angle) * once - half * half * twice;
  }

  Matrix3d forth;
  Matrix3d back;
};

struct Kind {
  ObstacleKind kind;
  PlaceOnObstacle (*place)(const Obstacle&, const Matrix3d& turn, const Vector3d& r,
                           const Vector3d& reference);
};
constexpr std::array<Kind, 3> kinds{{{ObstacleKind::plane, place_on_plane},
                                     {ObstacleKind::cylinder, place_on_cylinder},
                                     {ObstacleKind::sphere, place_on_sphere}}};

constexpr std::array<ObstacleEntry, 3> entries{
    {{ObstacleKind::plane, "plane", "point, normal"},
     {ObstacleKind::cylinder, "cylinder", "point, axis, radius; a circle in 2D; outside or inside"},
     {ObstacleKind::sphere, "sphere", "point, radius; outside or inside"}}};

/// In the meridian plane a sphere around the axis of revolution is a circle, a cylinder a straight line.
void take_meridian(Obstacle& obstacle) {
  if (obstacle.kind == ObstacleKind::sphere) {
    obstacle.kind = ObstacleKind::cylinder;
    obstacle.direction = Vector3d::UnitZ();
  } else if (obstacle.kind == ObstacleKind::cylinder) {
    obstacle.kind = ObstacleKind::plane;
    obstacle.point = {obstacle.radius, 0, 0};
    obstacle.direction = obstacle.sign * Vector3d::UnitX();
  }
}

} // namespace

std::span<const ObstacleEntry> all_obstacles() {
  return entries;
}

Pose Obstacle::pose(double t) const {
  Pose pose{.offset = translation(t)};
  if (!rotation)
    return pose;
  pose.offset += constraint::displacement_at(*rotation, point, t);
  pose.turn = Eigen::AngleAxisd(constraint::angle_at(*rotation, t), rotation->axis).toRotationMatrix();
  return pose;
}

/// With the arms d₀ and d₁ of both places: ½ (R − 1) d₀ + ½ (1 − Rᵀ) d₁, R the turn between the instants.
Vector3d Obstacle::way(const Vector3d& start, const Vector3d& end, double from, double to) const {
  const Vector3d before = translation(from), now = translation(to);
  Vector3d way = now - before;
  if (rotation) {
    const HalfTurns half(*rotation, from, to);
    way += half.forth * (start - rotation->about - before) + half.back * (end - rotation->about - now);
  }
  return way;
}

Matrix3d Obstacle::way_by_end(double from, double to) const {
  return rotation ? HalfTurns(*rotation, from, to).back : Matrix3d::Zero();
}

Vector3d Obstacle::translation(double t) const {
  Vector3d moved = vector_of(move);
  for (std::size_t axis = 0; axis < functions.size(); ++axis)
    if (functions[axis])
      moved[static_cast<Eigen::Index>(axis)] *= value_at(*functions[axis], t);
  constexpr std::array<double, 3> anywhere{};
  for (std::size_t axis = 0; axis < base.size(); ++axis)
    if (base[axis])
      moved[static_cast<Eigen::Index>(axis)] += base[axis]->at(anywhere, t);
  return moved;
}

bool Obstacle::moves() const {
  const auto is_there = [](const auto& function) { return function.has_value(); };
  return rotation || std::ranges::any_of(functions, is_there) || std::ranges::any_of(base, is_there);
}

Obstacle make_obstacle(const study::Obstacle& obstacle, study::Physics physics,
                       const std::map<std::string, Function>& functions) {
  Obstacle made{.kind = obstacle.kind,
                .point = vector_of(obstacle.point),
                .radius = obstacle.radius,
                .sign = obstacle.side == study::ObstacleSide::inside ? -1.0 : 1.0,
                .move = {},
                .functions = {},
                .base = {},
                .rotation = {}};
  if (const Vector3d direction = vector_of(obstacle.direction); !direction.isZero(0))
    made.direction = direction.stableNormalized();
  if (physics == study::Physics::axisymmetric)
    take_meridian(made);
  for (std::size_t axis = 0; axis < obstacle.move.size(); ++axis) {
    const auto& moved = obstacle.move[axis];
    if (!moved)
      continue;
    made.move[axis] = moved->value;
    if (!moved->function.empty())
      made.functions[axis] = functions.at(moved->function);
  }
  return made;
}

PlaceOnObstacle place_on(const Obstacle& obstacle, const Pose& pose, const Vector3d& x,
                         const Vector3d& reference) {
  const auto kind = std::ranges::find(kinds, obstacle.kind, &Kind::kind);
  return kind->place(obstacle, pose.turn, x - obstacle.point - pose.offset, reference - obstacle.point);
}

} // namespace rubato::contact
