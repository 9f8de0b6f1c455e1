// SPDX-License-Identifier: LGPL-3.0-or-later
/// What holds and moves parts of bodies.
#pragma once

#include "rubato/study/values.hpp"

#include <array>
#include <optional>
#include <string>

namespace rubato::study {

/// A rigid rotation about a line that stays where it is, by an angle of any size that changes with time.
struct Rotation {
  std::array<double, 3> about{};       ///< a place on the line [length]
  std::array<double, 3> axis{0, 0, 1}; ///< along the line, of any length > 0; in the plane z
  Field angle;                         ///< [radians], by the right-hand rule: a number or an expression of t
  bool operator==(const Rotation&) const = default;
};

/// A direction across the axes along which a displacement is held or imposed.
struct ObliqueSupport {
  bool normal = false;               ///< along the outward normal of the faces of the group
  std::array<double, 3> direction{}; ///< else along this one, of any length > 0
  Field value;                       ///< [length]
  bool operator==(const ObliqueSupport&) const = default;
};

/// Displacement components held at 0 (`fix: [x, y]`) or imposed (`x: 0.1`, `y: {value: 1, function: ramp}`),
/// also along a direction across the axes, and rotations of a reference or of a group. Velocities and
/// accelerations may stand for the displacements that follow from them.
struct Support {
  std::string on;
  std::array<std::optional<Field>, 3> components;
  std::optional<ObliqueSupport> along = {};
  std::array<std::optional<Field>, 3> turns = {}; ///< of a reference about the axes [radians]
  /// Of all nodes of the group: every component is held, `components` are added to what it displaces.
  std::optional<Rotation> rotate = {};
  std::optional<double> until = {}; ///< instant at which it lets go, to the end without
  bool operator==(const Support&) const = default;
};

} // namespace rubato::study
