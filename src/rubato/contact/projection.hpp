// SPDX-License-Identifier: LGPL-3.0-or-later
/// Orthogonal projection of a point on one curved face, and on the reference cell's limits.
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace rubato::contact {

/// Coordinates of the nodes of a face, one a column; at most nine.
using FaceCoordinates = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 9>;

/// Shape functions of a face and their derivatives at one reference point; only the first node_count nodes'
/// entries are set.
struct FaceShape {
  std::array<double, 9> values;
  std::array<double, 18> gradients; ///< ∂N_i/∂ξ_a at i · dimension + a
  std::array<double, 36> hessians;  ///< ∂²N_i/∂ξ_a∂ξ_b at (i · dimension + a) · dimension + b

  double gradient(Eigen::Index node, int direction, int dimension) const {
    return gradients[static_cast<std::size_t>(node * dimension + direction)];
  }
};

FaceShape face_shape(CellType type, const Eigen::Vector2d& xi);
/// The shape functions alone.
std::array<double, 9> face_values(CellType type, const Eigen::Vector2d& xi);

/// Position and parametric derivatives of a face at one reference point. In 2D the second direction is e_z,
/// so that tangent₁ × tangent₂ is the outward normal there as well.
struct FaceGeometry {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero(); ///< x,_a
  std::array<std::array<Eigen::Vector3d, 2>, 2> curvatures;                   ///< x,_ab
};

FaceGeometry face_geometry(CellType type, const FaceCoordinates& nodes, const FaceShape& shape);
FaceGeometry face_geometry(CellType type, const FaceCoordinates& nodes, const Eigen::Vector2d& xi);

/// The outward unit normal at ξ; 0 where the face has no area.
Eigen::Vector3d outward_normal(CellType type, const FaceCoordinates& nodes, const Eigen::Vector2d& xi);

/// Gradients of the shape functions along the surface, in space [1/length]; 0 where the face has no area.
/// Only the first node_count entries are set.
std::array<Eigen::Vector3d, 9> surface_gradients(CellType type, const FaceCoordinates& nodes,
                                                 const Eigen::Vector2d& xi);

/// x(ξ) alone.
Eigen::Vector3d face_position(CellType type, const FaceCoordinates& nodes, const Eigen::Vector2d& xi);

struct Projection {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();      ///< of the unconstrained orthogonal projection
  Eigen::Vector2d clamped = Eigen::Vector2d::Zero(); ///< closest point of the reference face to `xi`
  /// ∂clamped/∂xi: identity inside, a projection on a side or an edge beyond it, zero at a corner.
  Eigen::Matrix2d clamp_derivative = Eigen::Matrix2d::Identity();
  double overshoot = 0; ///< |xi − clamped|, 0 inside
  bool converged = false;

  bool inside() const { return overshoot == 0; }
};

/// Moves `xi` to the closest point of the reference face in the parametric plane; within 1e-12 it counts as
/// inside. Fills clamped, clamp_derivative and overshoot from xi.
void clamp_to_face(CellType type, Projection& projection);

/// Which projections are asked for: those that aren't can be left as soon as that is known.
enum class Wanted { any, inside };

/// Solves (x_s − x(ξ))·x,_a(ξ) = 0 by Newton's method from the middle of the face, then clamps. When only one
/// inside is wanted, a result outside is rough.
Projection project(CellType type, const FaceCoordinates& nodes, const Eigen::Vector3d& point,
                   Wanted wanted = Wanted::any);

} // namespace rubato::contact
