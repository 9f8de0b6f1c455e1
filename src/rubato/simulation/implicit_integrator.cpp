// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/simulation/implicit_integrator.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/processor_time.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/start.hpp"
#include "rubato/step/told_state.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

namespace rubato::simulation {
namespace {

/// The end of another run goes on only on the same unknowns and contact points, and where the past counts
/// with the same materials.
const step::State& checked_end(const model::Model& model, const step::State* previous) {
  if (previous == nullptr)
    throw std::invalid_argument("a study that starts from another run needs the end of that run");
  if (fits(model, *previous) && (remembers_alike(model, *previous) || !study::remembers(model.study)))
    return *previous;
  throw InputError({fault_at(
      "time.start.from",
      fmt::format("run '{}' cannot start from the end of run '{}': that one has another mesh, other "
                  "contact zones or materials that remember something else",
                  model.study.name, model.study.time.start_run))});
}

step::State first_state(const model::Model& model, const time::Scheme& scheme, const Start& start) {
  if (start.memento != nullptr)
    return step::resumed_state(model, start.memento->state);
  const auto& settings = model.study.time;
  if (settings.start == study::StartKind::from_run)
    return step::continued_state(model, scheme, checked_end(model, start.previous), settings.begin);
  return step::initial_state(model, scheme, settings.begin,
                             settings.start != study::StartKind::at_rest_unloaded);
}

/// Of Newton's method: three with an old tangent do about what one with its own does, and two with the
/// symmetric tangent of a conserving scheme. A step whose symmetric tangents led nowhere is nearly too long,
/// however few iterations the exact one took.
int iterations_of(const time::Scheme& scheme, const step::StepReport& report) {
  constexpr int too_many = 12;
  if (report.exact_tangent)
    return too_many;
  const int own = std::min(report.factorisations, report.bulk_iterations);
  const int all = own + (report.bulk_iterations - own + 2) / 3;
  return scheme.conserving ? (all + 1) / 2 : all;
}

} // namespace

ImplicitIntegrator::ImplicitIntegrator(const model::Model& model, const Start& start)
    : stages_(model, time::instants_of(model.study.time)), scheme_(time::make_scheme(model.study.time)),
      tell_memory_(start.tell_memory), systems_(std::in_place, model, scheme_, tell_memory_),
      state_(first_state(model, scheme_, start)), control_(model.study.time, state_->t),
      account_(model, scheme_, *state_), next_account_(account_),
      end_(time::instants_of(model.study.time).back()) {
  if (start.memento != nullptr)
    restore(*start.memento);
  if (!finished())
    prepare();
}

void ImplicitIntegrator::prepare() {
  begin_stage();
  const auto& system = systems_->of(control_.length());
  const auto asked = model().study.solver;
  if ((asked == study::Solver::condensed || asked == study::Solver::iterative) && !system.compliance)
    throw InputError(
        fmt::format("solver: found {}, but the effective matrix is not positive definite without "
                    "contact; expected auto or full",
                    study::word_of(study::solver_words, asked)));
  method_ = fmt::format("solver {}", step::solver_of(model(), system));
}

/// Where supports have ended at the instant of the state. Doing it again changes nothing.
void ImplicitIntegrator::begin_stage() {
  auto shortening = state_->shortening;
  stages_.lock_preloads_at(state_->t, state_->motion.u, shortening);
  if (shortening != state_->shortening)
    state_.changeable().shortening = shortening;
  if (!stages_.go_to_begin_at(state_->t, state_->shortening))
    return;
  take_model();
  step::release(model(), scheme_, state_.changeable());
}

/// What belongs to the model of another stage is made anew.
void ImplicitIntegrator::take_model() {
  systems_.emplace(model(), scheme_, tell_memory_);
  account_ = step::EnergyAccount(model(), scheme_, account_.ledger(), account_.overlaps());
  next_account_ = account_;
}

Trial ImplicitIntegrator::make(const GoesOn& goes_on) {
  const double start = processor_seconds();
  begin_stage();
  Trial trial;
  trial.attempt = next();
  step::GoesOn asked;
  if (goes_on)
    asked = [&](const step::ProgressState& state) { return goes_on({trial.attempt, state}); };
  trial.state = std::move(spare_);
  trial.report = step::advance(model(), scheme_, systems_->of(control_.length()), *state_, trial.attempt.end,
                               trial.state, asked);
  if (trial.report.outcome == step::Outcome::interrupted)
    return trial;
  if (trial.report.converged())
    step::refuse_large_plastic_step(model(), *state_, trial.state, trial.report);
  trial.attempt.accepted = trial.report.converged();
  trial.attempt.seconds = processor_seconds() - start;
  trial.spent.iterations = trial.report.iterations;
  if (trial.attempt.accepted) {
    trial.attempt.steps = trial.spent.steps = 1;
    trial.last = trial.attempt.end == end_;
    next_account_ = account_;
    next_account_.enter(*state_, trial.state);
    trial.energy = next_account_.ledger();
  } else {
    trial.final = !control_.can_cut();
    trial.spent.cuts = trial.final ? 0 : 1;
  }
  return trial;
}

void ImplicitIntegrator::accept(Trial trial) {
  control_.accept(iterations_of(scheme_, trial.report));
  std::swap(account_, next_account_);
  spare_ = state_.replace(std::move(trial.state));
}

void ImplicitIntegrator::reject(const Trial& trial) {
  if (!trial.final)
    control_.cut();
}

void ImplicitIntegrator::restore(const Memento& memento) {
  const auto& progress = std::get<ImplicitProgress>(memento.progress);
  auto state = step::resumed_state(model(), memento.state);
  time::StepControl control(model().study.time, state.t);
  control.go_on(progress.place);
  if (stages_.go_to_end_at(state.t, state.shortening))
    take_model();
  step::EnergyAccount account(model(), scheme_, progress.energy, progress.overlaps);
  // Copied; from here on nothing fails.
  state_.replace(std::move(state));
  control_ = std::move(control);
  account_ = std::move(account);
}

} // namespace rubato::simulation
