// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies of linear elasticity in small strain: f_int = K u, U = ½ u·K u, K assembled once; with temperatures
/// f_int = K u − f(t), U = ½ u·K u − u·f(t) + U_held(t). Springs by tables add what K
/// lacks of them.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/domain/balance.hpp"
#include "rubato/domain/evaluation.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/law_springs.hpp"
#include "rubato/domain/line_springs.hpp"
#include "rubato/domain/quadrature_states.hpp"
#include "rubato/linalg/block_matrix.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>

namespace rubato::domain {

class LinearDomain {
public:
  /// No dofs.
  LinearDomain() = default;
  /// `stiffness`: K of the cells and of all springs, symmetric, in whole blocks of `components` (2 or 3).
  /// `heat`: null without temperatures. `springs`: those by tables, whose held slopes K has. With several
  /// ranks in `workers` the stiffness is this one's part (linalg/ranked_matrix.hpp); forces and energies are
  /// those of all.
  LinearDomain(SparseMatrix&& stiffness, int components, std::shared_ptr<const Heat> heat = nullptr,
               std::vector<LawSpring> springs = {}, const Workers& workers = {});

  static constexpr bool is_linear = true;

  Failed evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                  const Wanted& wanted) const;
  double energy(const Eigen::VectorXd& u, const Eigen::VectorXd& forces, double t,
                const QuadratureStates& states) const;
  Eigen::VectorXd constant_forces(const Eigen::VectorXd& u, double t) const;
  /// Materials take nothing: all that is put into them is stored.
  Balance balance(const QuadratureStates&, const QuadratureStates&) const { return {}; }
  double back_stress_energy(const QuadratureStates&) const { return 0; }
  double hourglass_energy(const Eigen::VectorXd&) const { return 0; }
  const Heat* heat() const { return heat_.get(); }
  std::span<const LawSpring> law_springs() const { return springs_; }
  static std::span<const LineSpring> line_springs() { return {}; }
  const SparseMatrix& initial_tangent() const { return *stiffness_; }
  /// What `evaluate` gives but for forces, which are what this rank adds to those of all.
  void evaluate_own(const StepSpan& step, const Wanted& wanted) const;
  /// y = K x, both with an entry a dof, by this rank's part of K.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  PlasticStep plastic_step(const QuadratureStates&, const QuadratureStates&) const { return {}; }
  double largest_eigenvalue(const Eigen::VectorXd& inverse_mass, const AddUp& add_up,
                            const Admit& admit) const;
  bool has_finite_strain() const { return false; }
  bool has_own_scheme() const { return false; }
  double growth(const Eigen::VectorXd&, const QuadratureStates&, const LawPath&, double, double) const {
    return 0;
  }

private:
  void copy_stiffness(SparseMatrix& tangent) const;
  void own_forces_at(const Eigen::VectorXd& u, double t, Eigen::VectorXd& forces) const;

  /// Shared by copies, which only read it.
  std::shared_ptr<const SparseMatrix> stiffness_ = std::make_shared<const SparseMatrix>();
  std::shared_ptr<const Heat> heat_;
  std::vector<LawSpring> springs_;
  Threads threads_;
  Ranks ranks_;
  /// The same K: its product reads least memory. Nothing where K is 0.
  std::optional<linalg::SymmetricBlockMatrix> product_;
};

} // namespace rubato::domain
