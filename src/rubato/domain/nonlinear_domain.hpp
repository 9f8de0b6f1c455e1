// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies whose forces are not a constant matrix times their displacements, and whatever else is constant:
/// f_int = K u + Σ f(cells) + Σ f(lines), U = ½ u·K u + Σ U(cells) + Σ U(lines), K of the constant cells and
/// of springs, with their heat and springs by tables as in LinearDomain. Lines are springs along the current
/// line between their ends.
#pragma once

#include "rubato/domain/evaluation.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/law_springs.hpp"
#include "rubato/domain/line_springs.hpp"
#include "rubato/domain/linear_domain.hpp"
#include "rubato/domain/nonlinear_cells.hpp"
#include "rubato/domain/quadrature_states.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace rubato::domain {

class NonlinearDomain {
public:
  /// `constant`: K of the cells that are constant and of springs. `initial`: the same with the tangents of
  /// the other cells where nothing has happened yet; nothing where nobody asks for it. Both have the pattern
  /// that `cells` have places in. With several ranks in `workers` they are this one's parts, and `cells` its
  /// own. `lines`: all of them on every rank. `constant` has entries at their dofs; the first rank alone adds
  /// their forces and tangents.
  NonlinearDomain(SparseMatrix&& constant, std::optional<SparseMatrix>&& initial,
                  std::shared_ptr<const NonlinearCells> cells, int components,
                  std::shared_ptr<const Heat> heat = nullptr, std::vector<LawSpring> springs = {},
                  const Workers& workers = {}, std::vector<LineSpring> lines = {});

  static constexpr bool is_linear = false;

  Failed evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                  const Wanted& wanted) const;
  double energy(const Eigen::VectorXd& u, const Eigen::VectorXd& forces, double t,
                const QuadratureStates& states) const;
  Eigen::VectorXd constant_forces(const Eigen::VectorXd& u, double t) const;
  Balance balance(const QuadratureStates& old, const QuadratureStates& now) const;
  double back_stress_energy(const QuadratureStates& states) const {
    return ranks_.sum(cells_->back_stress_energy(states));
  }
  const Heat* heat() const { return constant_.heat(); }
  std::span<const LawSpring> law_springs() const { return constant_.law_springs(); }
  std::span<const LineSpring> line_springs() const { return lines_; }
  /// Throws InputError where there is none.
  const SparseMatrix& initial_tangent() const;
  PlasticStep plastic_step(const QuadratureStates& old, const QuadratureStates& now) const;
  double largest_eigenvalue(const Eigen::VectorXd& inverse_mass, const AddUp& add_up,
                            const Admit& admit) const;
  bool has_finite_strain() const { return cells_->has_finite_strain(); }
  bool has_own_scheme() const { return cells_->has_own_scheme(); }
  double hourglass_energy(const Eigen::VectorXd& u) const { return ranks_.sum(cells_->hourglass_energy(u)); }
  double growth(const Eigen::VectorXd& u, const QuadratureStates& states, const LawPath& path, double rate,
                double t) const {
    return cells_->growth(u, states, path, rate, heat(), t);
  }

private:
  Failed add_lines(const StepSpan& step, const Wanted& wanted) const;

  LinearDomain constant_;
  /// Shared by copies, which only read them.
  std::shared_ptr<const SparseMatrix> initial_; ///< null where nobody asks for it
  std::shared_ptr<const NonlinearCells> cells_;
  std::vector<LineSpring> lines_;
  Ranks ranks_;
};

} // namespace rubato::domain
