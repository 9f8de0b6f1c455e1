// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/advance.hpp"

#include "rubato/step/levels.hpp"

#include <algorithm>
#include <array>

namespace rubato::step {
namespace {

using Eigen::VectorXd;
using model::Model;

/// Augmentations tried one after the other. They do not change the answer, only which points are guessed to
/// touch and to stick on the way there.
constexpr std::array<Variant, 3> augmentations{{{1, 1, 1}, {1, 0.01, 0.1}, {1, 10, 10}}};
/// Parts of μ tried one after the other, each from the last one's solution, when the whole of it fails.
constexpr std::array<double, 5> friction_parts{0, 0.25, 0.5, 0.75, 1};

/// One step from one place, tried in several ways.
class Attempts {
public:
  Attempts(const Model& model, const time::Scheme& scheme, EffectiveSystem& system, const State& committed,
           double t)
      : model_(model), scheme_(scheme), system_(system), committed_(committed), t_(t) {}

  /// Each starts afresh; the first that converges ends it.
  StepReport vary_augmentation(State& trial) {
    StepReport report;
    for (const auto& variant : augmentations) {
      trial = predicted();
      report = solve(variant, trial);
      if (report.converged() || !has_augmentation())
        break;
    }
    return report;
  }

  /// Friction from none to all of it, each part from the last one's solution.
  StepReport raise_friction(State& trial) {
    StepReport report;
    trial = predicted();
    for (const double part : friction_parts) {
      report = solve({part, 1, 1}, trial);
      if (!report.converged())
        break;
    }
    report.friction_continuation = true;
    return report;
  }

  bool has_friction() const {
    return std::ranges::any_of(model_.zones, [](const auto& zone) { return zone.settings.friction > 0; });
  }

private:
  /// Also counts what earlier attempts have cost.
  StepReport solve(const Variant& variant, State& trial) {
    Newton newton(model_, scheme_, system_, committed_, t_, variant);
    auto report = solve_levels(model_, newton, committed_, trial);
    report.iterations = spent_ += report.iterations;
    return report;
  }

  /// Without one, every attempt is the same.
  bool has_augmentation() const {
    return std::ranges::any_of(model_.zones, [](const contact::Zone& zone) {
      return contact::is_exact(zone.settings.method) ||
             (zone.settings.friction > 0 &&
              zone.settings.friction_method == deck::FrictionMethod::augmented_lagrangian);
    });
  }

  /// Predicted motion with the imposed displacements of the step's end.
  State predicted() const {
    State trial = committed_;
    trial.motion = time::predict(scheme_, system_.step, committed_.motion);
    const VectorXd imposed = model::imposed_displacements(model_, t_);
    VectorXd d = VectorXd::Zero(trial.motion.u.size());
    for (std::size_t i = 0; i < model_.constraints.size(); ++i) {
      const int dof = model_.constraints[i].dof;
      d[dof] = imposed[static_cast<Eigen::Index>(i)] - trial.motion.u[dof];
    }
    time::correct(system_.coefficients, d, trial.motion);
    return trial;
  }

  const Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const State& committed_;
  double t_;
  int spent_ = 0;
};

} // namespace

StepReport advance(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                   const State& committed, double t, State& trial) {
  Attempts attempts(model, scheme, system, committed, t);
  auto report = attempts.vary_augmentation(trial);
  if (!report.converged() && attempts.has_friction())
    report = attempts.raise_friction(trial);
  return report;
}

} // namespace rubato::step
