// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/obstacle.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/function.hpp"

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

Vector3d product(const Matrix3d& m, const Vector3d& v) {
  Vector3d sum(0, 0, 0);
  for (int j = 0; j < 3; ++j)
    add_scaled(v[j], column_of(m, j), sum);
  return sum;
}

/// The matrix of a turn by an angle about a unit axis (O. Rodrigues).
Matrix3d turn_about(const Vector3d& axis, double angle) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  Matrix3d turn;
  for (int j = 0; j < 3; ++j) {
    const Vector3d unit(j == 0, j == 1, j == 2);
    const auto across = cross(axis, unit);
    for (int i = 0; i < 3; ++i)
      turn(i, j) = (1 - cosine) * axis[j] * axis[i] + cosine * unit[i] + sine * across[i];
  }
  return turn;
}

/// A unit vector across a unit vector: e_z × n in 2D, so that τ₂ = e_z.
Vector3d across(const Vector3d& n) {
  int axis = 2;
  for (const int other : {1, 0})
    if (std::abs(n[other]) < std::abs(n[axis]))
      axis = other;
  return unit_of(cross(Vector3d(axis == 0, axis == 1, axis == 2), n));
}

Vector3d vector_of(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

/// Distance and normal from the part of r that points away from a middle: all of a sphere's, of a cylinder's
/// what is across its `axis`; 0: there is none.
PlaceOnObstacle round_place(const Obstacle& obstacle, const Vector3d& r, const Vector3d& axis) {
  const auto part = part_across(axis, r);
  const double distance = length_of(part);
  PlaceOnObstacle place;
  place.gap = obstacle.sign * (distance - obstacle.radius);
  if (distance <= no_direction * obstacle.radius) {
    place.normal = scaled(obstacle.sign, across(obstacle.direction));
    return place;
  }
  const auto e = unit_of(part);
  place.normal = scaled(obstacle.sign, e);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      place.curvature(i, j) = obstacle.sign / distance * ((i == j ? 1 : 0) - axis[i] * axis[j] - e[i] * e[j]);
  return place;
}

PlaceOnObstacle place_on_plane(const Obstacle& obstacle, const Matrix3d& turn, const Vector3d& r,
                               const Vector3d& /*reference*/) {
  PlaceOnObstacle place;
  place.normal = product(turn, obstacle.direction);
  place.gap = dot(place.normal, r);
  place.tangent = product(turn, across(obstacle.direction));
  return place;
}

PlaceOnObstacle place_on_cylinder(const Obstacle& obstacle, const Matrix3d& turn, const Vector3d& r,
                                  const Vector3d& /*reference*/) {
  const auto axis = product(turn, obstacle.direction);
  auto place = round_place(obstacle, r, axis);
  place.tangent = cross(axis, place.normal);
  return place;
}

/// The least turn from n₀ to n takes a vector t ⊥ n₀ to t − (t·n)(n₀ + n)/(1 + n₀·n).
PlaceOnObstacle place_on_sphere(const Obstacle& obstacle, const Matrix3d& /*turn*/, const Vector3d& r,
                                const Vector3d& reference) {
  const Vector3d no_axis(0, 0, 0);
  auto place = round_place(obstacle, r, no_axis);
  const Vector3d start = round_place(obstacle, reference, no_axis).normal;
  const auto tangent = across(start);
  const double turn = 1 + dot(start, place.normal);
  if (turn <= no_direction) { // the opposite place: every great circle leads there
    place.tangent = unit_of(part_across(place.normal, tangent));
    return place;
  }
  place.tangent =
      difference_of(tangent, scaled(dot(tangent, place.normal) / turn, sum_of(start, place.normal)));
  place.spin = scaled(1 / turn, cross(place.normal, start));
  return place;
}

/// ½ (R − 1) and ½ (1 − Rᵀ), R the turn between two instants.
struct HalfTurns {
  HalfTurns(const constraint::Rotation& rotation, double from, double to) {
    const double angle = constraint::angle_at(rotation, to) - constraint::angle_at(rotation, from);
    const double half = std::sin(angle / 2); // 1 − cos θ = 2 sin²(θ/2), which keeps its digits
    for (int i = 0; i < 3; ++i) {
      const auto once = cross(rotation.axis, Vector3d(i == 0, i == 1, i == 2));
      const auto twice = cross(rotation.axis, once);
      for (int j = 0; j < 3; ++j) {
        forth(j, i) = 0.5 * std::sin(angle) * once[j] + half * half * twice[j];
        back(j, i) = 0.5 * std::sin(angle) * once[j] - half * half * twice[j];
      }
    }
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
    obstacle.direction = {0, 0, 1};
  } else if (obstacle.kind == ObstacleKind::cylinder) {
    obstacle.kind = ObstacleKind::plane;
    obstacle.point = {obstacle.radius, 0, 0};
    obstacle.direction = {obstacle.sign, 0, 0};
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
  add_scaled(1, constraint::displacement_at(*rotation, point, t), pose.offset);
  pose.turn = turn_about(rotation->axis, constraint::angle_at(*rotation, t));
  return pose;
}

/// With the arms d₀ and d₁ of both places: ½ (R − 1) d₀ + ½ (1 − Rᵀ) d₁, R the turn between the instants.
Vector3d Obstacle::way(const Vector3d& start, const Vector3d& end, double from, double to) const {
  const Vector3d before = translation(from), now = translation(to);
  auto way = difference_of(now, before);
  if (rotation) {
    const HalfTurns half(*rotation, from, to);
    const auto first_arm = difference_of(difference_of(start, rotation->about), before);
    const auto last_arm = difference_of(difference_of(end, rotation->about), now);
    add_scaled(1, sum_of(product(half.forth, first_arm), product(half.back, last_arm)), way);
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
  if (const Vector3d direction = vector_of(obstacle.direction); !is_zero(direction))
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
  const auto* const kind =
      std::find_if(kinds.begin(), kinds.end(), [&](const Kind& one) { return one.kind == obstacle.kind; });
  return kind->place(obstacle, pose.turn, difference_of(difference_of(x, obstacle.point), pose.offset),
                     difference_of(reference, obstacle.point));
}

} // namespace rubato::contact
