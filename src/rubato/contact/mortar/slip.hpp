// SPDX-License-Identifier: LGPL-3.0-or-later
/// The slip of a slave node in a step.
///
///   Δs_a = τ_a¹·G_j(x¹) − τ_a⁰·G_j(x⁰)        ⁰ start, ¹ end of the step, both with B of the end
/// A rigid motion changes neither B nor G in its own frame: its slip is zero whatever the gap. To second
/// order it is the slip from differences of D and M (M. Gitterle et al., Int. J. Numer. Methods Eng. 84
/// (2010) 543–571), and linear in u¹ while B and the frames are held: dΔs_a = τ_a¹·Σ B_ji du_i / w_j.
#pragma once

#include "rubato/contact/mortar/operators.hpp"

namespace rubato::contact::mortar {

/// Δs of a node; 0 unless it is kept. `position(node)` and `start_position(node)` of mesh nodes at the end
/// and the start of the step; `start_tangents`: the node's frame at the start. `anchor_motion`: how far an
/// obstacle has come in the step.
template <class Position, class StartPosition>
Eigen::Vector2d slip(const Node& node, const Position& position,
                     const Eigen::Matrix<double, 3, 2>& start_tangents, const StartPosition& start_position,
                     const Eigen::Vector3d& anchor_motion = Eigen::Vector3d::Zero()) {
  if (!node.kept())
    return Eigen::Vector2d::Zero();
  const Eigen::Vector3d end = gap_vector(node, position);
  const Eigen::Vector3d start = gap_vector(node, start_position) + anchor_motion;
  return node.tangents.transpose() * end - start_tangents.transpose() * start;
}

} // namespace rubato::contact::mortar
