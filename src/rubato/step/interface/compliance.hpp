// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a bulk that keeps its effective matrix A answers to forces on its contact surfaces: A factored once,
/// and the surface compliance S = B A⁻¹ Bᵀ, B picking the contact unknowns. S of a body is computed when
/// first asked for: whole, or of large surfaces some columns or blocks only, as few contact points are ever
/// active.
#pragma once

#include "rubato/linalg/split_factor.hpp"
#include "rubato/step/interface/block_compliance.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace rubato::step {

/// A force on one displacement of the surface.
struct ForceAt {
  int interface_dof = 0;
  double force = 0;
};

class Compliance {
public:
  /// Surfaces of bodies up to this size have S computed whole: three seconds at most.
  static constexpr Eigen::Index usual_largest_whole = 5000;
  /// Neighbouring columns of larger surfaces that are always computed together: enough for matrix–matrix
  /// products, few that are never asked for. In space they belong to a patch of 4 by 4 nodes. The last digits
  /// of a column depend on which columns are computed with it; as these are always the same, they don't
  /// depend on what was asked for before, and a resumed run has the same ones.
  static constexpr Eigen::Index block_size = 48;

  /// `free_dofs`: the dof of every unknown; `dofs`: how many there are. Surfaces that the factor eliminates
  /// within their bodies are large ones.
  Compliance(linalg::SplitFactor factor, std::span<const int> free_dofs, Eigen::Index dofs,
             Eigen::Index largest_whole = usual_largest_whole);

  const linalg::SplitFactor& factor() const { return factor_; }
  /// A⁻¹ force
  Eigen::VectorXd solve(const Eigen::VectorXd& force) const { return factor_.solve(force); }

  /// The unknowns of the surfaces; an index in this list is called an interface dof.
  const std::vector<int>& surface() const { return factor_.surface(); }
  const std::vector<int>& dof_of_interface_dof() const { return dofs_; }
  /// −1 for dofs that are held or not on a surface.
  const std::vector<int>& interface_dof_of_dof() const { return interface_dofs_; }

  /// S for these interface dofs.
  Eigen::MatrixXd between(std::span<const int> interface_dofs);
  /// The same for interface dofs that all lie on the body of the first, of which there is one; into `s`.
  void within_body(std::span<const int> interface_dofs, Eigen::MatrixXd& s);
  /// Whether forces can be taken together by `between_forces`.
  bool takes_forces_together() const;
  /// Fᵀ S F, with F one row an interface dof: of some hundreds of forces on thin bodies this is less work
  /// than S between all dofs that they act on.
  Eigen::MatrixXd between_forces(const linalg::SparseMatrix& forces) const;
  /// d += factor S force, one an interface dof; cheap where most of the force is zero.
  void add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d);
  /// The same with the force given by its entries.
  void add(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d);

  /// How far a unit force at an interface dof moves it.
  double own(int interface_dof) {
    const int body = body_of(interface_dof);
    const int position = interface_dof - first_of_body(body);
    return in_blocks(body) ? blocks_[static_cast<std::size_t>(body)]->own(position)
                           : column(interface_dof)[position];
  }

private:
  int body_of(int interface_dof) const { return body_of_[static_cast<std::size_t>(interface_dof)]; }
  int first_of_body(int body) const { return factor_.body_starts()[static_cast<std::size_t>(body)]; }
  bool in_blocks(int body) const {
    return has_blocks_ && blocks_[static_cast<std::size_t>(body)].has_value();
  }
  const double* column(int interface_dof);
  const Eigen::MatrixXd& whole(std::size_t body);
  void add_gathered(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d);
  void compute(int body, Eigen::Index place);

  linalg::SplitFactor factor_;
  Eigen::Index largest_whole_;
  std::vector<int> dofs_;
  std::vector<int> interface_dofs_;
  std::vector<int> body_of_;                           ///< by interface dof
  std::vector<Eigen::MatrixXd> s_;                     ///< by body: empty until used
  std::vector<char> known_;                            ///< by interface dof: whether its column is computed
  std::vector<std::optional<BlockCompliance>> blocks_; ///< by body, of surfaces eliminated within theirs
  bool has_blocks_ = false;
};

} // namespace rubato::step
