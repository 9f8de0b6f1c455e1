// SPDX-License-Identifier: LGPL-3.0-or-later
/// Gap, slip and frame of a paired contact point, with their exact derivatives.
///
/// The point's local unknowns q are the displacements of its slave nodes, then of its master face's nodes,
/// component by component. With x_s the slave point and ξ̄ its clamped projection on the master face
/// (docs/theory/contact-kinematics.md):
///   g = n·(x_s − x_m(ξ̄)) + offset,   g > 0 open;  n leaves the master; offset: the zone's (gap_offset.hpp)
///   Δs_a = τ_a·[(u_s − u_s⁰) − Σ N_j(ξ̄)(u_mj − u_mj⁰)],  ⁰ = start of the step
///   τ₁ = t₁/|t₁|, τ₂ = n × τ₁
/// The projection moves with q: (t_a·t_b − r·x,_ab) dξ_b = t_a·(dx_s − ΣN_j dx_j) + r·ΣN_j,_a dx_j, r = x_s −
/// x_m(ξ) (Laursen, Computational Contact and Impact Mechanics, 2002, ch. 5).
///
/// Whatever the face, all of these depend linearly on a few motions of the point only, which is how they are
/// computed:
///   e = δx_s − Σ N_j(ξ̄) δu_j,   m_a = Σ N_j,a(ξ̄) δu_j
/// where the projection is clamped, the same two at ξ, and where the slave or averages at nodes
/// (averaged_normal.hpp) turn the normal, how they do. The
/// frame stays orthonormal, so that three numbers say how it turns:
///   dτ₁ = α τ₂ + β n,   dτ₂ = −α τ₁ + γ n,   dn = −β τ₁ − γ τ₂
#pragma once

#include "rubato/contact/pairing.hpp"
#include "rubato/contact/stencil.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace rubato::contact {

/// Derivatives with respect to q, one column an unknown.
template <int Rows> using Variation = Eigen::Matrix<double, Rows, Eigen::Dynamic>;

struct Kinematics {
  Stencil stencil;
  int parametric_dimension = 2;
  Eigen::Vector3d normal;
  Eigen::Matrix<double, 3, 2> tangents; ///< τ₁, τ₂; in 2D only τ₁ counts
  double gap = 0;
  Eigen::Vector2d slip = Eigen::Vector2d::Zero();
  /// What an obstacle has instead of nodes, 0 on a master with faces: the place the point faces, and how far
  /// the obstacle's surface has come there since the start of the step.
  Eigen::Vector3d closest_point = Eigen::Vector3d::Zero();
  Eigen::Vector3d obstacle_displacement = Eigen::Vector3d::Zero();
  /// What gap and slip are counted from: less the zone's offset, and what a held frame adds.
  double gap_origin = 0;
  /// Where the gap does not move as the stencil says, the weights by which it does; nodes as there. Else
  /// empty.
  Eigen::VectorXd gap_weights;
  Eigen::Vector2d slip_origin = Eigen::Vector2d::Zero();

  /// Of a tie, whose frame stands along the axes: the normal of the surface; else 0.
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();

  Variation<2> d_projection; ///< dξ̄
  Variation<3> d_normal;
  std::array<Variation<3>, 2> d_tangent;
  Variation<1> d_gap;
  Variation<2> d_slip;
  /// δn_s − δn_m over q at a place that does not move, where the slave or averages at nodes give the normal.
  /// Else unused.
  Variation<3> d_given_normal;
  /// −∂N_j/∂ξ_b(ξ̄) on master nodes, 0 on slave nodes: the weights' own change is shape_slope · dξ̄.
  Eigen::Matrix<double, Eigen::Dynamic, 2> shape_slope;

  int unknowns() const { return stencil.unknowns(); }

  double gap_weight(Eigen::Index node, int component) const {
    return gap_weights.size() > 0 ? gap_weights[node] : stencil.weight(node, component);
  }
  /// Of places, value(node): what the gap follows along the normal.
  template <class Value> Eigen::Vector3d gap_vector(const Value& value) const {
    Eigen::Vector3d total(0, 0, 0);
    if (gap_weights.size() == 0)
      total = stencil.sum(value);
    for (Eigen::Index i = 0; i < gap_weights.size(); ++i) {
      const Eigen::Vector3d of_node = value(stencil.nodes[static_cast<std::size_t>(i)]);
      for (int c = 0; c < 3; ++c)
        total[c] += gap_weights[i] * of_node[c];
    }
    for (int c = 0; c < 3; ++c)
      total[c] -= closest_point[c];
    return total;
  }
};

/// Everything about a paired point that a contact law asks for. The pair must be one of find_pairs' for the
/// same configuration.
Kinematics evaluate_kinematics(const Zone& zone, const SlavePoint& point, const Pair& pair,
                               const Configuration& configuration);

/// The same in the storage of an earlier evaluation: nothing is allocated when the point has as many unknowns
/// as it had then.
void evaluate_kinematics(const Zone& zone, const SlavePoint& point, const Pair& pair,
                         const Configuration& configuration, Kinematics& into);

/// The same without derivatives, which stay whatever they were. Before an obstacle they cost nothing and are
/// there.
void measure_kinematics(const Zone& zone, const SlavePoint& point, const Pair& pair,
                        const Configuration& configuration, Kinematics& into);

} // namespace rubato::contact
