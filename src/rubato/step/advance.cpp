// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/advance.hpp"

#include "rubato/contact/springs.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/common/nested_loops.hpp"
#include "rubato/step/common/newton.hpp"
#include "rubato/step/common/pressed_afar.hpp"
#include "rubato/step/full/whole_system.hpp"
#include "rubato/step/interface/condensed.hpp"
#include "rubato/step/interface/predictor_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace rubato::step {
namespace {

using Eigen::VectorXd;
using model::Model;

/// Augmentations tried one after the other. They do not change the answer, only which points are taken to
/// touch and to stick on the way there.
constexpr std::array<RetrySettings, 2> other_augmentations{
    {{.normal_multiple = 0.01, .tangential_multiple = 0.1, .start = Start::last_step},
     {.normal_multiple = 10, .tangential_multiple = 10, .start = Start::last_step}}};
/// Parts of μ tried one after the other, each from the last one's solution, when the whole of it fails.
constexpr std::array<double, 5> friction_parts{0, 0.25, 0.5, 0.75, 1};

/// One step from one place, tried in several ways.
class Attempts {
public:
  Attempts(const Model& model, const time::Scheme& scheme, EffectiveSystem& system, const State& committed,
           double t, const GoesOn& goes_on)
      : model_(model), scheme_(scheme), system_(system), committed_(committed), t_(t), progress_(goes_on),
        other_start_(other_start(model, system)),
        has_augmentation_(std::ranges::any_of(model.zones, contact::has_augmentation)) {}

  StepReport plainly(State& trial) { return afresh({}, trial); }
  /// A search along moves takes fewer iterations than those that come no nearer for long, but may fail where
  /// these come to an end after all.
  StepReport hurriedly(State& trial) { return afresh({.hurries = true}, trial); }

  /// Contact stands in the matrix of every iteration, from here on: what it holds is stable then. Where no
  /// contact is, the matrix may have negative eigenvalues from here on.
  StepReport whole(State& trial) {
    whole_ = was_whole_ = true;
    auto report = plainly(trial);
    if (report.failed() && knows_search(report))
      report = search(trial);
    return report;
  }

  /// The same for once. Where springs of contact make a matrix positive definite, they are in the way of
  /// bodies that flow or slip: iterates come nearer slowly. With contact itself in it they do so in few.
  StepReport whole_once(State& trial) {
    auto report = whole(trial);
    whole_ = false;
    return report;
  }

  bool were_whole() const { return was_whole_; }

  /// The exact tangent ends where the symmetric one near it goes round.
  StepReport exactly(State& trial) {
    auto report = afresh({.exact_tangent = true}, trial);
    report.exact_tangent = true;
    return report;
  }

  /// Without a factor every matrix has the exact one already.
  bool has_exact_tangent() const {
    return scheme_.conserving && !model_.domain.is_linear() && system_.compliance && !whole_ &&
           !prediction_is_exact(model_) && may_be_whole();
  }

  /// A study that is to be solved by iterations never has its whole system factored: that may not fit.
  bool may_be_whole() const { return model_.study.solver != study::Solver::iterative; }

  /// Moves of nonlinear bodies that make it worse are cut short.
  StepReport search(State& trial) { return afresh({.searches = true}, trial); }

  bool can_search(const StepReport& report) const { return !whole_ && knows_search(report); }

  StepReport from_other_start(State& trial) { return afresh({.start = *other_start_}, trial); }

  /// Other augmentations start from the last step too, and are tried instead where there are any.
  bool has_other_start() const {
    return other_start_ && !(other_start_ == Start::last_step && has_augmentation_);
  }

  /// The first that doesn't fail ends it.
  StepReport vary_augmentation(State& trial) {
    StepReport report;
    for (const auto& variant : other_augmentations)
      if (report = afresh(variant, trial); !report.failed())
        break;
    return report;
  }

  /// Without one, every attempt is the same.
  bool has_augmentation() const { return has_augmentation_; }

  /// Points on the border of two faces may never settle on one of them while everything moves at once.
  StepReport loop_geometry(State& trial) {
    auto report = afresh({.geometry_by_loop = true}, trial);
    report.geometry_by_loop = true;
    return report;
  }

  bool has_newton_geometry() const {
    return std::ranges::any_of(model_.zones, [](const contact::Zone& zone) {
      return zone.settings.geometry.by == study::Iteration::newton;
    });
  }

  /// A loop that goes round among sets of points that touch has no way out of them.
  StepReport free_status(State& trial) { return afresh({.status_by_newton = true}, trial); }

  bool has_status_loop() const {
    return std::ranges::any_of(model_.zones, [](const contact::Zone& zone) {
      return zone.settings.status.by == study::Iteration::fixed_point;
    });
  }

  /// Friction from none to all of it, each part from the last one's solution.
  StepReport raise_friction(State& trial) {
    StepReport report;
    predict(model_, scheme_, system_, committed_, t_, trial);
    for (const double part : friction_parts) {
      const auto start = part == friction_parts.front() ? Start::usual : Start::last_step;
      report = solve({.friction_part = part, .start = start}, trial);
      if (!report.converged())
        break;
    }
    report.friction_continuation = true;
    return report;
  }

  bool has_friction() const {
    return std::ranges::any_of(model_.zones, [](const auto& zone) { return zone.settings.friction > 0; });
  }

  bool has_contact() const { return !model_.zones.empty(); }

private:
  /// Of an attempt before.
  bool knows_search(const StepReport& report) const {
    return !model_.study.time.arc_length && report.bulk_iterations > 1;
  }

  StepReport afresh(const RetrySettings& variant, State& trial) {
    predict(model_, scheme_, system_, committed_, t_, trial);
    return solve(variant, trial);
  }

  /// Also counts what earlier attempts have cost.
  StepReport solve(RetrySettings variant, State& trial) {
    variant.indefinite = whole_;
    ContactEvaluator side(model_, scheme_, system_, committed_, variant);
    const bool whole =
        whole_ || variant.exact_tangent || model_.study.time.arc_length || !can_condense(model_, system_);
    auto report = whole ? attempted<WholeSystem>(side, trial) : attempted<Condensed>(side, trial);
    report.iterations = spent_ += report.iterations;
    report.indefinite = report.indefinite || whole_;
    if (report.converged())
      refuse_if_pressed_afar(trial, report);
    return report;
  }

  void refuse_if_pressed_afar(const State& trial, StepReport& report) const {
    if (const auto found = pressed_afar(model_, trial)) {
      report.outcome = Outcome::pressed_afar;
      report.unmet = {*found};
    }
  }

  /// Solves with the effective matrix that come to no end are how the attempt ends.
  template <NewtonSystem Solver> StepReport attempted(ContactEvaluator& side, State& trial) {
    try {
      return solve_by<Solver>(side, trial);
    } catch (const linalg::NotSolved& error) {
      StepReport report;
      report.outcome = Outcome::unsolved;
      report.unmet = {{.criterion = Criterion::linear_solve, .value = error.left, .allowed = error.allowed}};
      return report;
    }
  }

  template <NewtonSystem Solver> StepReport solve_by(ContactEvaluator& side, State& trial) {
    Solver solver(model_, scheme_, system_, committed_, t_, side, progress_);
    return solve_levels(
        model_, side,
        [&](State& to, const Frozen& frozen) {
          return run_newton(solver, model_.study.newton.max_iterations, progress_, to, frozen);
        },
        committed_, trial);
  }

  const Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const State& committed_;
  double t_;
  Progress progress_;
  std::optional<Start> other_start_;
  bool has_augmentation_;
  bool whole_ = false;
  bool was_whole_ = false;
  int spent_ = 0;
};

std::string solver_text(const Model& model, const EffectiveSystem& system) {
  if (model.study.solver == study::Solver::full)
    return "full, as the deck says";
  if (model.study.time.arc_length)
    return "full: the factor of the loads is unknown";
  if (!system.compliance)
    return "full: the effective matrix is not positive definite without contact";
  if (model.study.solver == study::Solver::iterative)
    return fmt::format("iterative{}: conjugate gradients with multigrid in place of a factor of the bulk",
                       model.zones.empty() ? "" : ", condensed on contact points");
  if (!model.domain.is_linear())
    return fmt::format("{}{} factored {}", model.zones.empty() ? "" : "condensed on contact points: ",
                       domain::is_linear(model.bulk) ? "connectors rotate, the tangent is"
                                                     : "the bulk is nonlinear, its tangent",
                       model.study.newton.tangent == study::TangentChoice::full
                           ? "in every iteration"
                           : "in every step, and when iterations come to little");
  if (model.zones.empty())
    return "the bulk factored once a step length";
  return "condensed on contact points: the bulk is linear and factored once a step length";
}

} // namespace

std::string solver_of(const Model& model, const EffectiveSystem& system) {
  auto text = solver_text(model, system);
  if (system.has_free_bodies)
    text += "; bodies that only contact or soft springs hold have weak springs in it, whose forces are "
            "gone at the end of a step";
  return text;
}

void predict(const Model& model, const time::Scheme& scheme, const EffectiveSystem& system,
             const State& committed, double t, State& trial) {
  trial = committed;
  trial.t = t;
  time::predict(scheme, system.step, committed.motion, trial.motion);
  time::correct(system.coefficients, model.reduction.correction(t, trial.motion.u), trial.motion);
}

State predict(const Model& model, const time::Scheme& scheme, const EffectiveSystem& system,
              const State& committed, double t) {
  State trial;
  predict(model, scheme, system, committed, t, trial);
  return trial;
}

StepReport advance(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                   const State& committed, double t, State& trial, const GoesOn& goes_on) {
  Attempts attempts(model, scheme, system, committed, t, goes_on);
  auto report = attempts.hurriedly(trial);
  const bool was_given_up = report.stagnates;
  if (report.failed() && was_given_up && report.indefinite && attempts.has_contact() &&
      attempts.may_be_whole())
    report = attempts.whole_once(trial);
  if (report.outcome == Outcome::indefinite && attempts.may_be_whole())
    report = attempts.whole(trial);
  if (report.outcome == Outcome::too_many_iterations && attempts.has_exact_tangent())
    report = attempts.exactly(trial);
  if (report.failed() && attempts.can_search(report))
    report = attempts.search(trial);
  if (report.failed() && was_given_up)
    report = attempts.plainly(trial);
  if (report.failed() && attempts.has_other_start())
    report = attempts.from_other_start(trial);
  if (report.failed() && attempts.has_augmentation())
    report = attempts.vary_augmentation(trial);
  if (report.failed() && attempts.has_newton_geometry())
    report = attempts.loop_geometry(trial);
  if (report.failed() && attempts.has_status_loop())
    report = attempts.free_status(trial);
  if (report.failed() && attempts.has_friction())
    report = attempts.raise_friction(trial);
  if (report.failed() && report.indefinite && !attempts.were_whole() && attempts.may_be_whole())
    report = attempts.whole(trial);
  return report;
}

void refuse_large_plastic_step(const Model& model, const State& committed, const State& trial,
                               StepReport& report) {
  const auto& most = model.study.time.max_plastic_step;
  if (!most)
    return;
  const auto found = model.domain.plastic_step(committed.bulk_points, trial.bulk_points);
  if (found.growth <= *most)
    return;
  report.outcome = Outcome::plastic_step;
  report.unmet = {{.criterion = Criterion::plastic_step,
                   .node = model.mesh.nodes_of(found.cell).front(),
                   .value = found.growth,
                   .allowed = *most}};
}

} // namespace rubato::step
