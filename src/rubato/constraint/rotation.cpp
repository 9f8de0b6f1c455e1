// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/constraint/rotation.hpp"

#include "rubato/core/time_integral.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace rubato::constraint {
namespace {

using Eigen::Vector3d;

constexpr std::array<double, 3> anywhere{};

/// k×d and k×(k×d).
struct Levers {
  Levers(const Rotation& rotation, const Vector3d& place)
      : once(rotation.axis.cross(place - rotation.about)), twice(rotation.axis.cross(once)) {}

  Vector3d once;
  Vector3d twice;
};

double angle_rate(const Rotation& rotation, double t, int order) {
  return rotation.angle.multiplied_at(anywhere, t) * rubato::rate_at(rotation.angle.function, t, order);
}

} // namespace

double angle_at(const Rotation& rotation, double t) {
  return rotation.angle.at(anywhere, t);
}

Vector3d displacement_at(const Rotation& rotation, const Vector3d& place, double t) {
  const Levers levers(rotation, place);
  const double angle = angle_at(rotation, t);
  const double half = std::sin(angle / 2); // 1 − cos θ = 2 sin²(θ/2), which keeps its digits
  return std::sin(angle) * levers.once + 2 * half * half * levers.twice;
}

Vector3d rate_at(const Rotation& rotation, const Vector3d& place, double t, int order) {
  const Levers levers(rotation, place);
  const double angle = angle_at(rotation, t);
  const Vector3d first = std::cos(angle) * levers.once + std::sin(angle) * levers.twice;
  const double speed = angle_rate(rotation, t, 1);
  if (order == 1)
    return speed * first;
  const Vector3d second = -std::sin(angle) * levers.once + std::cos(angle) * levers.twice;
  return angle_rate(rotation, t, 2) * first + speed * speed * second;
}

bool leaves(const Rotation& rotation, const Vector3d& place, int axis) {
  const Levers levers(rotation, place);
  return levers.once[axis] == 0 && levers.twice[axis] == 0;
}

} // namespace rubato::constraint
