// SPDX-License-Identifier: LGPL-3.0-or-later
/// Rigid rotations about a line that stays where it is, exact for any angle θ(t).
///
/// With the unit vector k along the line, the place c on it and d = X − c, turned by the right-hand rule:
///   u = (R − 1) d = sin θ k×d + (1 − cos θ) k×(k×d)
///   u̇ = θ̇ u′,  ü = θ̈ u′ + θ̇² u″,  u′ = cos θ k×d + sin θ k×(k×d),  u″ = −sin θ k×d + cos θ k×(k×d)
#pragma once

#include "rubato/core/field_function.hpp"

#include <Eigen/Core>

namespace rubato::constraint {

struct Rotation {
  Eigen::Vector3d about = Eigen::Vector3d::Zero(); ///< c [length]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(); ///< k, unit
  FieldFunction angle;                             ///< θ [radians], of time alone

  bool operator==(const Rotation& other) const {
    return about == other.about && axis == other.axis && angle == other.angle;
  }
};

/// θ(t) [radians]. This and what follows throw InputError when the angle is no finite number at t.
double angle_at(const Rotation& rotation, double t);

/// u of an undeformed place at instant t [length].
Eigen::Vector3d displacement_at(const Rotation& rotation, const Eigen::Vector3d& place, double t);

/// u̇ (order 1) or ü (2) where the angle is given by its velocity or acceleration, else 0: who gives an angle
/// says nothing of its rates.
Eigen::Vector3d rate_at(const Rotation& rotation, const Eigen::Vector3d& place, double t, int order);

/// Whether the rotation never displaces a place along an axis of the model, 0 to 2, whatever its angle.
bool leaves(const Rotation& rotation, const Eigen::Vector3d& place, int axis);

} // namespace rubato::constraint
