// SPDX-License-Identifier: LGPL-3.0-or-later
/// The mass of an explicit run on the unknowns that relations leave of displacements, u = T q + g:
///   M̄ = Tᵀ M T,   T q̈ = T M̄⁻¹ Tᵀ f
/// M is lumped, with masses of references beside it. M̄ is diagonal except for coupled unknowns: those that
/// dependent dofs follow, and those of references with a mass. Their part of M̄ is factored once.
///
/// T M̄⁻¹ Tᵀ ≤ M⁻¹ on dofs that are not prescribed: relations never raise the largest eigenvalue of springs
/// against the masses.
#pragma once

#include "rubato/linalg/direct_solver.hpp"
#include "rubato/linalg/sparse_matrix.hpp"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace rubato::constraint {
class Reduction;
} // namespace rubato::constraint

namespace rubato::step {

class ConstrainedMass {
public:
  /// `lumped`: one a dof, above 0 where the dof is not prescribed. `attached`: masses beside it, of as many
  /// rows, or empty. Both must outlive this; the reduction need not.
  ConstrainedMass(const Eigen::VectorXd& lumped, linalg::SparseMatrix attached,
                  const constraint::Reduction& reduction);

  /// Whether unknowns are coupled.
  bool couples() const { return !coupled_.empty(); }
  /// Their dofs, ascending.
  const std::vector<int>& coupled() const { return coupled_; }
  bool has_attached() const { return attached_.nonZeros() > 0; }

  /// Puts T M̄⁻¹ Tᵀ f on coupled dofs and on those that follow them, other entries of `motion` stay. Both have
  /// an entry a dof.
  void respond(const Eigen::VectorXd& force, Eigen::VectorXd& motion) const;

  /// M x, an entry a dof.
  Eigen::VectorXd times(const Eigen::VectorXd& x) const;
  /// x·M y of the attached masses alone.
  double attached_product(const Eigen::VectorXd& x, const Eigen::VectorXd& y) const;

  /// P x with P = T M̄⁻¹ Tᵀ M: the motion nearest to x, in the norm of M, that the relations admit. Without
  /// attached masses.
  void admit(Eigen::VectorXd& x) const;
  /// Pᵀ f of forces. Without attached masses.
  void admit_forces(Eigen::VectorXd& f) const;

private:
  struct Follower {
    int dof = 0;
    std::vector<int> of; ///< places in coupled_
    std::vector<double> coefficients;
  };

  void collect(const constraint::Reduction& reduction);
  void factor(const constraint::Reduction& reduction);
  template <class Visit> void for_each_dof(const Visit& visit) const;

  const Eigen::VectorXd* lumped_;
  linalg::SparseMatrix attached_;
  std::vector<int> coupled_;
  std::vector<Follower> followers_;
  std::shared_ptr<const linalg::CholeskyFactor> factor_; ///< of coupled unknowns; null without
};

} // namespace rubato::step
