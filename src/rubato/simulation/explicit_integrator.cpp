// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/simulation/explicit_integrator.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/processor_time.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/time/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>

namespace rubato::simulation {
namespace {

/// Quotients this little above a whole number are that number but for rounding.
constexpr double rounding = 1e-9;
/// Counting points in contact copies the state of zones.
constexpr std::chrono::seconds between_counts(1);

int whole(double quotient) {
  constexpr double most = 1e9;
  return static_cast<int>(std::clamp(std::ceil(quotient - rounding), 1.0, most));
}

/// The begin and the instants of records, those of `time.stops` among them.
std::vector<double> instants_of(const study::TimeStepping& time, int records) {
  std::vector<double> instants{time.begin};
  for (int record = 1; record < records; ++record)
    instants.push_back(time::as_meant(time.begin + record * (time.end - time.begin) / records, time.begin));
  instants.push_back(time.end);
  return time::with_stops(std::move(instants), time.stops);
}

/// The end of the run that the study starts from; nullptr where it starts from its own begin.
const step::State* end_before(const model::Model& model, const Start& start) {
  if (start.memento != nullptr || model.study.time.start != study::StartKind::from_run)
    return nullptr;
  if (start.previous == nullptr)
    throw std::invalid_argument("a study that starts from another run needs the end of that run");
  if (start.previous->motion.u.size() == model.dofs.dof_count &&
      (remembers_alike(model, *start.previous) || !study::remembers(model.study)))
    return start.previous;
  throw InputError({fault_at(
      "time.start.from", fmt::format("run '{}' cannot start from the end of run '{}': that one has another "
                                     "mesh or materials that remember something else",
                                     model.study.name, model.study.time.start_run))});
}

/// Throws InputError when the study asks for steps that would not be stable.
void check_step(const study::TimeStepping& time, double stable) {
  if (time.step > stable)
    throw InputError(
        {fault_at("time.step",
                  fmt::format("time.step: found {:g}, expected at most the stable step of this model, {:g}, "
                              "or auto",
                              time.step, stable))});
}

} // namespace

ExplicitIntegrator::ExplicitIntegrator(const model::Model& model, const Start& start)
    : time_(model.study.time), motion_(model, end_before(model, start)), state_(motion_.state()),
      energy_(motion_.energy()), equal_records_(whole((time_.end - time_.begin) / time_.record)),
      instants_(instants_of(time_, equal_records_)), stages_(model, instants_) {
  const auto spectrum = motion_.spectrum();
  check_step(time_, spectrum.stable_step());
  limit_step(spectrum);
  if (start.memento != nullptr)
    restore(*start.memento);
}

/// The step never grows again: each change costs a little accuracy.
void ExplicitIntegrator::limit_step(const step::Spectrum& spectrum) {
  const double stable = spectrum.stable_step();
  limit_ = std::min(limit_, time_.step > 0 ? std::min(time_.step, stable) : time_.safety * stable);
}

std::string ExplicitIntegrator::method() const {
  const auto spectrum = motion_.spectrum();
  const double record = (time_.end - time_.begin) / equal_records_;
  const int steps = whole(record / limit_);
  const step::Spectrum free{spectrum.stiffness, 0, spectrum.damping};
  return fmt::format("stable step {:.4g}{}; steps of {:.4g}, {} a record, {} in all", spectrum.stable_step(),
                     spectrum.contact > 0 ? fmt::format(" ({:.4g} without contact)", free.stable_step()) : "",
                     record / steps, steps, std::int64_t{steps} * equal_records_);
}

Trial ExplicitIntegrator::make(const GoesOn& goes_on) {
  const double start = processor_seconds();
  Trial trial;
  trial.attempt = next();
  before_ = ExplicitProgress{motion_.memory(), limit_, energy_};
  if (stages_.go_to_begin_at(motion_.t(), {}))
    motion_.take_supports(stages_.model());
  const auto steps_before = motion_.steps();
  auto& report = trial.report;
  try {
    report.outcome = go_to(trial.attempt, goes_on, report.failed_cell);
  } catch (...) {
    go_back();
    throw;
  }
  if (report.failed_cell)
    report.unmet.push_back(
        {step::Criterion::cell, -1, stages_.model().mesh.nodes_of(report.failed_cell->cell).front()});
  trial.attempt.steps = trial.spent.steps = static_cast<int>(motion_.steps() - steps_before);
  if (report.outcome == step::Outcome::interrupted) {
    before_.reset();
    return trial;
  }
  trial.state = motion_.state();
  trial.attempt.accepted = report.converged();
  trial.attempt.seconds = processor_seconds() - start;
  if (report.converged())
    trial.energy = motion_.energy();
  trial.last = trial.attempt.end == time_.end;
  trial.final = true;
  return trial;
}

/// In steps that the bodies and the contact as they stand allow.
step::Outcome ExplicitIntegrator::go_to(const Attempt& attempt, const GoesOn& goes_on,
                                        domain::Failed& failed) {
  points_in_contact_ = step::points_in_contact(*state_);
  counted_ = std::chrono::steady_clock::now();
  while (true) {
    motion_.survey();
    limit_step(motion_.spectrum());
    const double left = attempt.end - motion_.t();
    const int steps = whole(left / limit_);
    const int part = std::min(steps, motion_.steps_between_surveys());
    failed = motion_.advance(part == steps ? attempt.end : motion_.t() + left * part / steps, part);
    if (failed)
      return step::Outcome::cell_failed;
    if (motion_.t() >= attempt.end)
      return motion_.is_finite() ? step::Outcome::converged : step::Outcome::not_finite;
    if (goes_on && !goes_on_from_here(attempt, goes_on))
      return step::Outcome::interrupted;
  }
}

bool ExplicitIntegrator::goes_on_from_here(const Attempt& attempt, const GoesOn& goes_on) {
  const auto now = std::chrono::steady_clock::now();
  if (now - counted_ >= between_counts) {
    counted_ = now;
    points_in_contact_ = motion_.points_in_contact();
  }
  return goes_on({attempt, {.contact_points = points_in_contact_}});
}

void ExplicitIntegrator::accept(Trial trial) {
  before_.reset();
  state_.replace(std::move(trial.state));
  energy_ = trial.energy;
  ++next_;
}

void ExplicitIntegrator::go_back() {
  take_stage_of(*before_);
  motion_.restore(before_->motion);
  limit_ = before_->limit;
  before_.reset();
}

/// What is kept of an instant at which supports end was kept before.
void ExplicitIntegrator::take_stage_of(const ExplicitProgress& progress) {
  if (stages_.go_to_end_at(progress.motion.t, {}))
    motion_.take_supports(stages_.model());
}

ExplicitProgress ExplicitIntegrator::progress() const {
  auto progress = before_ ? *before_ : ExplicitProgress{motion_.memory(), limit_, energy_};
  progress.motion = motion_.whole(std::move(progress.motion));
  return progress;
}

void ExplicitIntegrator::restore(const Memento& memento) {
  const auto& progress = std::get<ExplicitProgress>(memento.progress);
  auto state = memento.state;
  take_stage_of(progress);
  motion_.restore_whole(progress.motion);
  state_.replace(std::move(state));
  limit_ = progress.limit;
  energy_ = progress.energy ? *progress.energy : motion_.energy();
  next_ = first_record_ahead();
}

/// The first one that the motion has not reached.
std::size_t ExplicitIntegrator::first_record_ahead() const {
  std::size_t record = 1;
  while (record < instants_.size() && instants_[record] <= motion_.t() + rounding * time_.record)
    ++record;
  return record;
}

} // namespace rubato::simulation
