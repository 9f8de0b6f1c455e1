// SPDX-License-Identifier: LGPL-3.0-or-later
/// Stresses and strains for people to look at: at quadrature points, and from there to nodes.
#pragma once

#include "rubato/core/threads.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/quadrature_states.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::domain {

/// What has six components xx yy zz xy yz xz: true stress [force/area]; strain that the law of the material
/// sees, and the plastic part of it, as tensors, ε_xy = γ_xy/2.
enum class Tensor { stress, strain, plastic_strain };

/// One column a mesh node; 0 off the bulk.
using NodalTensors = Eigen::Matrix<double, 6, Eigen::Dynamic>;

struct NodalStress {
  NodalTensors stress;
  Eigen::VectorXd von_mises; ///< of the averaged stress
};

/// Takes values at the points of cell::stiffness_rule to the nodes of the cell, nodes × points: the linear
/// functions of the corners that fit the points best (least squares), evaluated at every node. Throws
/// std::invalid_argument for cells without mechanics.
const Eigen::MatrixXd& extrapolation(CellType type);

/// Stresses and strains of cells one by one, of a displacement `u` (size dof_count), the heat of an instant
/// and what its materials remember then (null: nothing has happened to them). Everything must outlive this.
class CellTensors {
public:
  CellTensors(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs, const Eigen::VectorXd& u,
              HeatAt heat = {}, const QuadratureStates* states = nullptr);

  /// At the points of cell::stiffness_rule, 6 × points, of a cell by its place in `bulk.cells`. In reduced
  /// cells all have what their one point has; in cells of lower order the function that is linear in each
  /// direction and has the values of their points.
  Eigen::MatrixXd at_points(Tensor what, std::size_t cell);
  /// The same extrapolated to the nodes of the cell, 6 × nodes.
  Eigen::MatrixXd at_nodes(Tensor what, std::size_t cell);
  /// p = ∫ √(2/3 dε^p:dε^p), 1 × points; 0 of laws that do not yield.
  Eigen::MatrixXd cumulated_plastic_strain(std::size_t cell);
  /// p extrapolated to the nodes of the cell, 1 × nodes; 0 where the extrapolation is negative.
  Eigen::MatrixXd cumulated_plastic_strain_at_nodes(std::size_t cell);

private:
  std::span<const double> states_of(std::size_t cell) const;
  std::span<const double> state_at(const Behaviour& behaviour, std::size_t cell, std::size_t point) const;
  Eigen::MatrixXd linear_at_points(Tensor what, std::size_t cell);
  Eigen::MatrixXd nonlinear_at_points(Tensor what, const Behaviour& behaviour, std::size_t cell);

  const mesh::Mesh& mesh_;
  const Bulk& bulk_;
  const DofMap& dofs_;
  const Eigen::VectorXd& u_;
  const Heat* heat_;
  Eigen::VectorXd temperatures_;
  const QuadratureStates* states_;
  std::vector<std::size_t> first_state_; ///< of each cell; empty when all are linear and integrated in full
  std::vector<double> untouched_;        ///< of a cell that nothing has happened to
  std::vector<double> local_;
  Eigen::MatrixXd strain_;
};

/// Stress or strain of the displacement `u` (size dof_count) extrapolated cell by cell, averaged at each node
/// over its cells with equal weights. Where materials meet, the average hides a jump: call it with the cells
/// of one material to see it.
NodalTensors nodal_tensors(Tensor what, const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                           const Eigen::VectorXd& u, HeatAt heat = {},
                           const QuadratureStates* states = nullptr, const Threads& threads = {});
/// The same of the cumulated plastic strain, one a mesh node.
Eigen::VectorXd nodal_plastic_strain(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                                     const Eigen::VectorXd& u, HeatAt heat = {},
                                     const QuadratureStates* states = nullptr, const Threads& threads = {});
/// Of stress, with von Mises'.
NodalStress nodal_stress(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                         const Eigen::VectorXd& u, HeatAt heat = {}, const QuadratureStates* states = nullptr,
                         const Threads& threads = {});

} // namespace rubato::domain
