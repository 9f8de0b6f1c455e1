// SPDX-License-Identifier: LGPL-3.0-or-later
/// States and steps that fulfil nothing but what their parts mean: identities of a scheme's formulas must
/// hold for them.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/step/common/bulk_tangent.hpp"
#include "rubato/step/start.hpp"

#include "support/model_of.hpp"
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace rubato::test {

/// A damped block, clamped on one side and pulled on the other, under its weight.
inline const std::string pulled_block = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [3, 2], sides: {left: clamp, right: pulled}}
physics: plane_strain
materials: {rubber: {young: 3, poisson: 0.3, density: 2, rayleigh: {stiffness: 0.1, mass: 0.2}}}
functions: {wave: {times: [0, 1, 2], values: [0.3, 1, -1]}}
supports:
  - {on: clamp, fix: [x, y]}
  - {on: pulled, x: {value: 0.5, function: wave}}
loads: [{gravity: {y: -2, function: wave}}]
time: {scheme: newmark, step: 0.5, end: 2}
)";

struct NamedScheme {
  std::string name;
  std::vector<deck::Setting> settings;
};

inline const std::vector<NamedScheme> every_implicit_scheme{
    {"Newmark", {}},
    {"NewmarkWithBetaAndGamma", {{"time.beta", "0.4"}, {"time.gamma", "0.7"}}},
    {"Hht", {{"time.scheme", "hht"}, {"time.alpha", "-0.3"}}},
    {"ModifiedAverageAcceleration",
     {{"time.scheme", "modified_average_acceleration"}, {"time.alpha", "-0.2"}}},
    {"GeneralizedAlpha", {{"time.scheme", "generalized_alpha"}, {"time.spectral_radius", "0.2"}}},
    {"WbzAlpha", {{"time.scheme", "wbz_alpha"}, {"time.alpha", "-0.3"}}},
    {"MoreauJean", {{"time.scheme", "moreau_jean"}}},
    {"MoreauJeanBeyondTheMiddle", {{"time.scheme", "moreau_jean"}, {"time.theta", "0.8"}}},
    {"EnergyMomentum", {{"time.scheme", "energy_momentum"}}},
    {"Static", {{"time.scheme", "static"}}},
};

class AnyStates {
public:
  explicit AnyStates(const NamedScheme& chosen) : AnyStates(model_of(pulled_block, chosen.settings)) {}
  /// `size`: of motions and forces; nonlinear cells keep their shape where it is small beside them.
  explicit AnyStates(test::BuiltModel given, double size = 1) : model(std::move(given)), size_(size) {}

  const test::BuiltModel model;
  const time::Scheme scheme = time::make_scheme(model.study.time);

  Eigen::VectorXd anything() {
    std::normal_distribution<double> normal;
    return Eigen::VectorXd::NullaryExpr(model.dofs.dof_count, [&] { return size_ * normal(random_); });
  }

  /// A state that fulfils nothing but what its parts mean.
  step::State any_state() {
    step::State state;
    state.motion = {anything(), anything(), anything()};
    if (!scheme.dynamic)
      state.motion = {state.motion.u, 0 * state.motion.v, 0 * state.motion.a};
    state.contact_force = anything();
    state.friction_force = anything();
    state.external_force = anything();
    state.residual_force = anything();
    state.reaction = anything();
    const Eigen::VectorXd undeformed = Eigen::VectorXd::Zero(model.dofs.dof_count);
    model.domain.evaluate({undeformed, state.motion.u, 0, 0}, model.domain.initial_states(),
                          state.bulk_points, {.records = true});
    state.bulk = step::bulk_forces(model, state);
    return state;
  }

  /// Any motion that Newmark's formulas allow, with any forces.
  step::State any_step_from(const step::State& before, double h) {
    auto now = any_state();
    now.t = before.t + h;
    now.motion = time::predict(scheme, h, before.motion);
    time::correct(time::coefficients_of(scheme, h), anything(), now.motion);
    now.bulk = step::bulk_forces(model, now);
    model.domain.evaluate({before.motion.u, now.motion.u, before.t, now.t, nullptr, step::forces_of(scheme)},
                          before.bulk_points, now.bulk_points,
                          {.forces = &now.bulk.internal, .records = true});
    for (const auto& support : model.reduction.prescribed())
      now.reaction[support.dof] = left_side(before, now)[support.dof];
    return now;
  }

  /// m₁ M a₁ + m₀ M a₀ + c₁ C v₁ + c₀ C v₀ + f₁ F₁ + f₀ F₀, as the matrices give it; of conserving schemes
  /// with internal forces of the step.
  Eigen::VectorXd left_side(const step::State& before, const step::State& now) const {
    Eigen::VectorXd at = now.motion.u;
    if (scheme.conserving)
      at = (0.5 * (before.motion.u + now.motion.u)).eval();
    const Eigen::VectorXd internal =
        model.domain.is_linear() ? model.domain.initial_tangent() * at : now.bulk.internal;
    Eigen::VectorXd sum = scheme.internal_weight() * internal - scheme.forces.now * now.external_force +
                          scheme.contact_weight() * now.contact_force +
                          scheme.forces.before * before.residual_force;
    if (scheme.dynamic)
      sum += scheme.inertia.now * (model.mass * now.motion.a) +
             scheme.inertia.before * (model.mass * before.motion.a) +
             scheme.damping.now * (model.damping * now.motion.v) +
             scheme.damping.before * (model.damping * before.motion.v);
    return sum;
  }

private:
  double size_ = 1;
  std::mt19937 random_{11};
};

} // namespace rubato::test
