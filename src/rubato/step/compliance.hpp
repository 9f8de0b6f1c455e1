// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a bulk that keeps its effective matrix A answers to forces on its contact surfaces: A factored once,
/// and the surface compliance S = B A⁻¹ Bᵀ, B picking the contact unknowns. Columns of S are computed when
/// first asked for: few contact points are ever active.
#pragma once

#include "rubato/linalg/split_factor.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::step {

class Compliance {
public:
  /// `free_dofs`: the dof of every unknown; `dofs`: how many there are.
  Compliance(linalg::SplitFactor factor, std::span<const int> free_dofs, Eigen::Index dofs);

  const linalg::SplitFactor& factor() const { return factor_; }
  /// A⁻¹ force
  Eigen::VectorXd solve(const Eigen::VectorXd& force) const { return factor_.solve(force); }

  /// The unknowns of the surfaces; an index in this list is a position.
  const std::vector<int>& surface() const { return factor_.surface(); }
  const std::vector<int>& dof_of_position() const { return dofs_; }
  /// −1 for dofs that are held or not on a surface.
  const std::vector<int>& position_of_dof() const { return positions_; }

  /// S for these unknowns, which must lie on the surfaces.
  Eigen::MatrixXd between_unknowns(std::span<const int> unknowns);
  /// S for these positions.
  Eigen::MatrixXd between(std::span<const int> positions);
  /// The same for positions that all lie on the body of the first.
  Eigen::MatrixXd within_body(std::span<const int> positions);
  /// d += factor S force, one a position; cheap where most of the force is zero.
  void add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d);
  /// Computes what is still missing of the columns of these positions, with their neighbours': many at once
  /// cost far less than one by one.
  void prepare(std::span<const int> positions);

private:
  /// A range of positions that forces on others do not move.
  struct Body {
    int first = 0;
    int size = 0;
  };
  void compute(std::size_t body, int first, int count);
  const double* column(int position);

  linalg::SplitFactor factor_;
  std::vector<int> dofs_;
  std::vector<int> positions_;
  std::vector<int> position_of_unknown_;
  std::vector<Body> bodies_;
  std::vector<int> body_of_;             ///< by position
  std::vector<Eigen::VectorXd> columns_; ///< by position: of its body, empty until used
};

} // namespace rubato::step
