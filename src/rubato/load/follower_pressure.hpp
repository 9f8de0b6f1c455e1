// SPDX-License-Identifier: LGPL-3.0-or-later
/// Pressure that stays normal to the faces it acts on, on the shape that they have at displacements u.
///
/// With the current place x(ξ, η) of a face, t = x,ξ × x,η out of the body (2D: x,ξ turned by −90°, times the
/// thickness or 2πr, r the current radius), p > 0 pushing into the body and N_i the shape functions:
///   f_i = −∫ N_i p t dξ dη
///   −∂f_i/∂u_j = ∫ N_i p [N_j,η x,ξ − N_j,ξ x,η]× dξ dη,  [a]× b = a × b
/// The derivative is not symmetric where the loaded surface has a border that moves: forces follow no
/// potential there. p belongs to the undeformed place. At u = 0 the forces are those of load::add_pressure.
///
/// K. Schweizerhof, E. Ramm, Displacement dependent pressure loads in nonlinear finite element analyses,
/// Comput. Struct. 18 (1984) 1099–1114.
#pragma once

#include "rubato/core/cell_type.hpp"
#include "rubato/core/field_function.hpp"
#include "rubato/domain/sparse_matrix.hpp"
#include "rubato/element/section.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::domain {
struct DofMap;
} // namespace rubato::domain

namespace rubato::mesh {
struct Mesh;
} // namespace rubato::mesh

namespace rubato::load {

struct Face;

/// A face under pressure. Nodes stand as those of load::Face.
struct FollowerFace {
  CellType type;
  std::vector<Eigen::Vector3d> places; ///< of its nodes, undeformed [length]
  std::vector<int> dofs;               ///< the first of each node
  /// At each quadrature point, without the function of time; none where the value changes with time
  /// otherwise [force/area].
  std::vector<double> pressure;
};

struct FollowerPressure {
  element::Section section;
  FieldFunction value; ///< p [force/area], of the undeformed place and time
  std::vector<FollowerFace> faces;
  bool is_controlled = false; ///< multiplied by a factor of the loads that whoever asks has to give
};

/// The pressure `value` on faces. Throws what add_pressure throws, and InputError where the value is no
/// finite number.
FollowerPressure make_follower_pressure(const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                        const element::Section& section, std::span<const Face> faces,
                                        FieldFunction value);

/// Adds its nodal forces at displacements u and instant t to `force`, both with an entry a dof [force].
/// Throws what the value throws.
void add_follower_force(const FollowerPressure& load, const Eigen::VectorXd& u, double t,
                        Eigen::VectorXd& force);

/// −∂f/∂u of a face, not symmetric; rows and columns are the components of its nodes, node by node
/// [force/length]. Faces have up to 9 nodes.
using FollowerStiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 27, 27>;
FollowerStiffness stiffness_of(const FollowerPressure& load, const FollowerFace& face,
                               const Eigen::VectorXd& u, double t);

/// Adds `factor` times the symmetric part of −∂f/∂u to a compressed matrix that has the places of the
/// stiffness: nodes of a face share a cell. Throws std::invalid_argument where it has not.
void add_follower_tangent(const FollowerPressure& load, const Eigen::VectorXd& u, double t, double factor,
                          domain::SparseMatrix& matrix);

} // namespace rubato::load
