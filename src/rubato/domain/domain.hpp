// SPDX-License-Identifier: LGPL-3.0-or-later
/// What deforms: internal forces, tangents and stored energy of all bodies and of the springs on them.
#pragma once

#include "rubato/domain/evaluation.hpp"
#include "rubato/domain/quadrature_states.hpp"

#include <Eigen/Core>

#include <memory>
#include <span>
#include <variant>

namespace rubato::domain {

struct Balance;
class Heat;
struct LawSpring;
struct LineSpring;
class LinearDomain;
class NonlinearDomain;

/// A step does not change a domain: it reads the quadrature states of its start and writes those of its end
/// into another object. So a step may be evaluated many times and rejected.
///
/// The kinds of domains are the alternatives of one variant. A new kind is a file with a class that has
/// LinearDomain's functions, and its row in `Kind`. Copies share theirs, which nothing changes.
class Domain {
public:
  using Kind = std::variant<LinearDomain, NonlinearDomain>;

  /// No dofs.
  Domain();
  /// `states`: those of cells that nothing has happened to. Callers include the headers of both kinds.
  Domain(Kind kind, QuadratureStates states);

  /// Answers what is wanted at the end of a step. `old`: the states at its start; `now`: another object,
  /// which becomes those at its end. Allocates nothing where the answers have their sizes already. Nothing
  /// comes back when every cell has an answer, as those of a linear domain always have.
  Failed evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                  const Wanted& wanted) const;

  /// Stored in the bodies and springs at displacements u and instant t with these internal forces and states,
  /// as `evaluate` has them, with records [force · length].
  double energy(const Eigen::VectorXd& u, const Eigen::VectorXd& forces, double t,
                const QuadratureStates& states) const;

  /// The part of the internal forces that comes from cells of a constant stiffness and from springs, with the
  /// forces of temperatures: K u − f(t) and what springs by tables add [force].
  Eigen::VectorXd constant_forces(const Eigen::VectorXd& u, double t) const;

  /// Where the work of the other part went in a step from `old` to `now`, states with records. Throws
  /// std::invalid_argument without them.
  Balance balance(const QuadratureStates& old, const QuadratureStates& now) const;
  /// What back stresses store, of states with records [force · length].
  double back_stress_energy(const QuadratureStates& states) const;

  /// What reduced cells store in hourglasses at displacements u; `energy` is without it [force · length].
  double hourglass_energy(const Eigen::VectorXd& u) const;
  /// Whether the work of the forces of nonlinear cells over a step may be another than what is stored and
  /// dissipated.
  bool has_own_scheme() const;

  /// Springs by tables.
  std::span<const LawSpring> law_springs() const;
  /// Springs and dashpots along the current line between their ends.
  std::span<const LineSpring> line_springs() const;

  /// Null where nothing has a temperature. Then internal forces change with time at the same displacements.
  const Heat* heat() const;

  /// Whether forces are the initial tangent times u, but for those of heat and of springs by tables, whatever
  /// happened before: what is made from one tangent, a factor above all, then holds for every step.
  bool is_linear() const;

  /// ∂f_int/∂u at u = 0 where nothing has happened yet [force/length]. Whoever wants scales, or an elastic
  /// stiffness by definition, takes this one. Throws InputError of a domain that is not linear in the model
  /// of an explicit run, where it is not assembled.
  const SparseMatrix& initial_tangent() const;

  /// How far materials have yielded in a step.
  PlasticStep plastic_step(const QuadratureStates& old, const QuadratureStates& now) const;

  /// A bound from above of the largest λ of K x = λ M x, K the initial tangent, at most 1 % beyond it
  /// [1/time²]. `inverse_mass`: of each dof, 0 where it is held. `admit` replaces displacements by those that
  /// relations admit, before K is multiplied. `add_up` then applies the transpose, too.
  double largest_eigenvalue(const Eigen::VectorXd& inverse_mass, const AddUp& add_up = {},
                            const Admit& admit = {}) const;

  /// By what the largest λ may have grown since nothing had happened, where cells of finite strain are
  /// compressed or grow stiffer; below 1 where it has not grown, 0 without such cells. `rate`: λ at first, as
  /// largest_eigenvalue gives it; the path leads to u and `states` at instant t. Of models of explicit runs
  /// only.
  double growth(const Eigen::VectorXd& u, const QuadratureStates& states, const LawPath& path, double rate,
                double t) const;
  bool has_finite_strain() const;

  /// What a run begins with.
  const QuadratureStates& initial_states() const { return initial_states_; }

private:
  std::shared_ptr<const Kind> kind_; ///< never null, but after a move
  QuadratureStates initial_states_;
};

} // namespace rubato::domain
