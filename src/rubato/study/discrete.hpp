// SPDX-License-Identifier: LGPL-3.0-or-later
/// Parts that are no cells: springs and dashpots between places, masses at nodes.
#pragma once

#include "rubato/core/linear_table.hpp"

#include <array>
#include <optional>
#include <string>

namespace rubato::study {

/// A spring and a dashpot side by side, without force where the nodes are undeformed and at rest unless a
/// table says so: on a node or a reference and another one; or on each node of a group and the ground.
struct Connector {
  std::string on;
  std::string to; ///< empty: the ground
  /// Of any length > 0. Not given: from `on` to `to` as they are undeformed.
  std::optional<std::array<double, 3>> along = {};
  /// Acts along the current line from `on` to `to` or to the anchor; the elongation is the change of its
  /// length. Without `along`.
  bool rotates = false;
  /// Place of the end at the ground, of connectors that rotate and have no `to` [length].
  std::optional<std::array<double, 3>> anchor = {};
  double stiffness = 0; ///< [force/length] ≥ 0
  double damping = 0;   ///< [force · time/length] ≥ 0
  /// Instead of `stiffness`: force against elongation. That is the displacement of `to` along the direction
  /// less that of `on`; to the ground that of `on`.
  std::optional<LinearTable> force = {};
  std::optional<LinearTable> damper = {}; ///< instead of `damping`: force by the rate of the elongation
  bool operator==(const Connector&) const = default;
};

/// Masses at the nodes of a group, or of a reference.
struct PointMasses {
  std::string on;
  double mass = 0; ///< of each node [mass] ≥ 0; in an axisymmetric model that of the ring
  /// Of a reference, moments of inertia about the axes through it [mass · length²] ≥ 0.
  std::array<double, 3> inertia{};
  bool operator==(const PointMasses&) const = default;
};

} // namespace rubato::study
