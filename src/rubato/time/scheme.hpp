// SPDX-License-Identifier: LGPL-3.0-or-later
/// Implicit time schemes: what the words of study/schemes.hpp mean.
///
/// A scheme is Newmark's pair β, γ and the weights of the terms of equilibrium at the end (now) and at the
/// start (before) of a step of length h:
///   m₁ M a₁ + m₀ M a₀ + c₁ C v₁ + c₀ C v₀ + f₁ F(u₁) + f₀ F(u₀) = 0,
///   F = internal + contact − external force (but for what nonsmooth and conserving say),
///   u₁ = ũ + d,  v₁ = ṽ + γ/(βh) d,  a₁ = ã + d/(βh²)
/// with the predictor ũ = u₀, ṽ = (β−γ)/β v₀ + (2β−γ)h/(2β) a₀, ã = −v₀/(βh) + (2β−1)/(2β) a₀.
#pragma once

#include <Eigen/Core>

namespace rubato::study {
struct TimeStepping;
} // namespace rubato::study

namespace rubato::time {

struct Weights {
  double now = 1;
  double before = 0;
};

struct Scheme {
  double beta = 0.25;
  double gamma = 0.5;
  Weights inertia;
  Weights damping;
  Weights forces;
  bool dynamic = true; ///< false: load steps in pseudo-time, no velocity and no acceleration
  /// Velocities may jump: a₁ and the contact force of a step are their means over it, with the weight 1 and
  /// without history, and contact is a law of velocities. γ = 1 and β = θ of the θ-method then.
  bool nonsmooth = false;
  /// Internal forces are those over a step that keep energy and momenta (domain::ForcesOf::step), with the
  /// weight 1 and without history.
  bool conserving = false;

  double contact_weight() const { return nonsmooth ? 1.0 : forces.now; }
  bool remembers_contact() const { return !nonsmooth; }
  double internal_weight() const { return conserving ? 1.0 : forces.now; }
  bool remembers_internal() const { return !conserving; }
};

/// newmark: β, γ given (default average acceleration). hht: Hilber, Hughes and Taylor (1977) with α ≤ 0,
/// damping unweighted as Code_Aster does. modified_average_acceleration: the same β, γ, equilibrium at the
/// end of the step. generalized_alpha: Chung and Hulbert (1993) from ρ_∞. wbz_alpha: the same β, γ as hht and
/// inertia (1−α) a₁ + α a₀ with α ≤ 0 (W. L. Wood, M. Bossak, O. C. Zienkiewicz, An alpha modification of
/// Newmark's method, Int. J. Numer. Methods Eng. 15 (1980) 1562–1566). moreau_jean: u₁ = u₀ + h (θ v₁ +
/// (1−θ) v₀), a₁ = (v₁ − v₀)/h, forces and damping weighted alike (M. Jean, The non-smooth contact dynamics
/// method, Comput. Methods Appl. Mech. Eng. 177 (1999) 235–257). energy_momentum: the same with θ = 1/2, its
/// internal forces those of O. Gonzalez, Exact energy and momentum conserving algorithms for general models
/// in nonlinear elasticity, Comput. Methods Appl. Mech. Eng. 190 (2000) 1763–1783. static_steps: no inertia.
/// Throws std::invalid_argument for central_difference, which step/explicit computes.
Scheme make_scheme(const study::TimeStepping& settings);

/// Whether high frequencies keep their energy, so that exact contact feeds them.
bool is_undamped(const Scheme& scheme);

/// The coefficients of one step: A = mass M + damping C + stiffness K is the effective matrix.
struct StepCoefficients {
  double velocity = 0;     ///< γ/(βh): dv per d
  double acceleration = 0; ///< 1/(βh²): da per d
  double mass = 0;
  double damping = 0;
  double stiffness = 1;
};
StepCoefficients coefficients_of(const Scheme& scheme, double step);

struct Motion {
  Eigen::VectorXd u, v, a;
};
/// The predictor: where the step ends if d = 0. Zero velocity and acceleration for static steps.
Motion predict(const Scheme& scheme, double step, const Motion& start);
/// The same into another object, in whose storage it fits.
void predict(const Scheme& scheme, double step, const Motion& start, Motion& end);
/// The acceleration alone.
Eigen::VectorXd predicted_acceleration(const Scheme& scheme, double step, const Motion& start);

/// u += d, v and a accordingly.
void correct(const StepCoefficients& coefficients, const Eigen::VectorXd& d, Motion& motion);

} // namespace rubato::time
