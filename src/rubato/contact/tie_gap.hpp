// SPDX-License-Identifier: LGPL-3.0-or-later
/// The gap vector of a tie whose surfaces do not touch. The vector keeps its length and turns with the
/// master. So a rigid motion of both sides needs no force (docs/theory/tied-gaps.md).
///
///   a_β = Σ_l α_lβ x_l,   n = a₁ × a₂ / |a₁ × a₂|,   e₁ = a₁/|a₁|,   e₂ = n × e₁
///   G(x) = γ₁ e₁ + γ₂ e₂ + γ₃ n
/// a_β are tangents of the master before the tied point, α_lβ slopes of the master's shape functions. In 2D
/// a₂ = e_z. Since Σ_l α_lβ = 0, a translation leaves G as it is, and a rotation Q makes it Q G. Forces by
/// the transposed derivative of the constraint then have no resultant moment.
#pragma once

#include "rubato/contact/stencil.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace rubato::contact {

struct TieGap {
  std::vector<std::size_t> places;     ///< of the master's nodes in the stencil of the point
  std::vector<Eigen::Vector2d> slopes; ///< α_l of these nodes [1/length]
  bool in_plane = false;
  Eigen::Vector3d parts = Eigen::Vector3d::Zero();  ///< γ [length]
  Eigen::Vector3d facing = Eigen::Vector3d::Zero(); ///< the normal of the surface, by the same frame
  std::array<bool, 3> rows{}; ///< the components of the constraint that this gap is part of
};

/// A value of a node of the master and the gradient of its shape function along the surface [1/length].
struct SurfaceGradient {
  std::size_t place = 0; ///< in the stencil of the point
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
};

/// Where a node is.
using NodePlace = std::function<Eigen::Vector3d(mesh::NodeIndex)>;

/// The gap of a point whose stencil is there. `gap`: the vector where nodes are at `at`; `normal`: a unit
/// normal of the surface there. No slopes where the gradients leave the frame without direction.
TieGap make_tie_gap(const Stencil& stencil, std::span<const SurfaceGradient> gradients,
                    const Eigen::Vector3d& gap, const Eigen::Vector3d& normal, const NodePlace& at);

struct TurnedGap {
  Eigen::Vector3d gap = Eigen::Vector3d::Zero();    ///< G by component
  Eigen::Vector3d facing = Eigen::Vector3d::Zero(); ///< the surface's normal; 0 without gaps
};

/// The gap vector where nodes are at `at`, and in `stencil.turning` −∂G/∂u there.
TurnedGap turn(std::span<const TieGap> gaps, const NodePlace& at, Stencil& stencil);

} // namespace rubato::contact
