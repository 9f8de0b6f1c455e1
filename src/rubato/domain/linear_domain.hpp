// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies of linear elasticity in small strain: f_int = K u, U = ½ u·K u, K assembled once; with temperatures
/// f_int = K u − f(t), U = ½ u·K u − u·f(t) + U_held(t). Springs by tables add what K
/// lacks of them.
#pragma once

#include "rubato/domain/evaluation.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/law_springs.hpp"
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
  /// `heat`: null without temperatures. `springs`: those by tables, whose held slopes K has.
  LinearDomain(SparseMatrix&& stiffness, int components, std::shared_ptr<const Heat> heat = nullptr,
               std::vector<LawSpring> springs = {});

  static constexpr bool is_linear = true;

  Failed evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                  const Wanted& wanted) const;
  double energy(const Eigen::VectorXd& u, const Eigen::VectorXd& forces, double t,
                const QuadratureStates& states) const;
  const Heat* heat() const { return heat_.get(); }
  std::span<const LawSpring> law_springs() const { return springs_; }
  const SparseMatrix& initial_tangent() const { return *stiffness_; }
  PlasticStep plastic_step(const QuadratureStates&, const QuadratureStates&) const { return {}; }
  double largest_eigenvalue(const Eigen::VectorXd& inverse_mass) const;

private:
  /// Shared by copies, which only read it.
  std::shared_ptr<const SparseMatrix> stiffness_ = std::make_shared<const SparseMatrix>();
  std::shared_ptr<const Heat> heat_;
  std::vector<LawSpring> springs_;
  std::optional<linalg::SymmetricBlockMatrix> product_; ///< the same K: its product reads least memory
};

} // namespace rubato::domain
