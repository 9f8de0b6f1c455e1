// SPDX-License-Identifier: LGPL-3.0-or-later
/// One implicit step: motion and contact solved together by Newton's method.
///
/// Geometry, friction threshold and contact status are all re-evaluated in every iteration (generalized
/// Newton); the tangent is exact. Unknowns are the free displacements and the contact multipliers:
///   [A + f₁ ∂f_c/∂u   f₁ ∂f_c/∂λ] [d ]     [residual ]
///   [  ∂e/∂u            ∂e/∂λ   ] [dλ] = − [equations]
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/step/compliance.hpp"
#include "rubato/step/linear_step.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <optional>

namespace rubato::step {

/// The effective matrix A = m M + c C + k K of one step length, on free dofs.
struct EffectiveSystem {
  double step = 0;
  time::StepCoefficients coefficients;
  model::SparseMatrix matrix;
  Eigen::VectorXd diagonal; ///< of every dof, constrained ones included
  std::vector<contact::ZoneCoefficients> zones;
  /// The factored matrix; nothing when every iteration solves the whole system.
  std::optional<Compliance> compliance;
};

/// Factors the matrix unless `engine` is full. Throws InputError when it is not positive definite: something
/// can move without resistance.
EffectiveSystem make_effective_system(const model::Model& model, const time::Scheme& scheme, double step,
                                      LinearEngine engine = LinearEngine::automatic);

/// Initial state: displacements and velocities 0, imposed displacements applied, M a = external − internal
/// force. `loaded_history` false takes the first history bracket as zero (Code_Aster's start). Throws
/// InputError when the mass matrix is singular.
State initial_state(const model::Model& model, const time::Scheme& scheme, double t, bool loaded_history);

/// Continues another run's end: u, multipliers and statuses are kept; velocity too when both runs are
/// dynamic; the acceleration follows from equilibrium with the contact forces in place.
State continued_state(const model::Model& model, const time::Scheme& scheme, const State& end, double t);

/// Advances `committed` to t. On success `trial` is the state at t. A failed attempt is repeated with
/// friction raised in parts before it is reported.
StepReport advance(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                   const State& committed, double t, State& trial);

} // namespace rubato::step
