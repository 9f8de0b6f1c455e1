// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/explicit_loop.hpp"

#include "rubato/core/writing.hpp"
#include "rubato/results/recorder.hpp"
#include "rubato/run/loop_parts.hpp"
#include "rubato/step/explicit.hpp"
#include "rubato/step/finiteness.hpp"
#include "rubato/time/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

namespace rubato::run {
namespace {

/// Quotients this little above a whole number are that number but for rounding.
constexpr double rounding = 1e-9;
/// Contact stiffens as points slide to lighter nodes of the master; in that many steps they move by a small
/// part of a face, which the safety of the step allows for.
constexpr int steps_between_estimates = 20;

int whole(double quotient) {
  return std::max(1, static_cast<int>(std::ceil(quotient - rounding)));
}

/// The begin and the instants of records, those of `time.stops` among them.
std::vector<double> instants_of(const study::TimeStepping& time, int records) {
  std::vector<double> instants{time.begin};
  for (int record = 1; record < records; ++record)
    instants.push_back(time::as_meant(time.begin + record * (time.end - time.begin) / records, time.begin));
  instants.push_back(time.end);
  return time::with_stops(std::move(instants), time.stops);
}

/// Throws InputError when the deck asks for steps that would not be stable.
void check_step(const study::TimeStepping& time, double stable) {
  if (time.step > stable)
    throw InputError(
        {fault_at("time.step",
                  fmt::format("time.step: found {:g}, expected at most the stable step of this model, {:g}, "
                              "or auto",
                              time.step, stable))});
}

class ExplicitLoop {
public:
  ExplicitLoop(const model::Model& model, RunContext& course, const Watch& watch)
      : model_(model), time_(model.study.time), course_(course), watch_(watch), motion_(model),
        keeper_(model.study, course, watch),
        energy_(model.study.name, watch, course.from ? course.from->record : step::EnergyRecord()) {
    const auto spectrum = motion_.spectrum();
    check_step(time_, spectrum.stable_step());
    equal_records_ = whole((time_.end - time_.begin) / time_.record);
    instants_ = instants_of(time_, equal_records_);
    limit_step(spectrum);
    if (course.from)
      go_on(*course.from);
    tell_steps(motion_.spectrum());
  }

  RunResult run(double setup_start) {
    start_recording();
    result_.setup_seconds += processor_seconds() - setup_start;
    loop_start_ = processor_seconds();
    for (auto i = next_record(); i < instants_.size() && result_.status == Status::complete; ++i)
      go_to(instants_[i]);
    result_.loop_seconds = loop_seconds();
    if (result_.status != Status::not_converged && keeper_.keeps_end())
      result_.kept = keep_checkpoint();
    result_.steps = static_cast<int>(motion_.steps());
    energy_.tell();
    result_.energy = energy_.record();
    result_.end = std::move(now_);
    finish();
    return std::move(result_);
  }

private:
  void go_on(const results::Checkpoint& from) {
    motion_.restore(from.progress.value().motion);
    limit_ = from.progress->limit;
    now_ = from.state;
    recorded_ = from.recorder.steps;
    result_.setup_seconds = from.spent.setup_seconds;
    former_loop_seconds_ = from.spent.loop_seconds;
  }

  void start_recording() {
    if (course_.from) {
      recorder_.emplace(model_, course_.folder, course_.from->recorder, now_);
      return;
    }
    take_folder(course_, model_.study.name, watch_);
    recorder_.emplace(model_, course_.folder);
    now_ = motion_.state();
    recorder_->start(now_);
    recorder_->energy(now_.t, motion_.energy());
  }

  /// The first one that the motion has not reached.
  std::size_t next_record() const {
    std::size_t record = 1;
    while (record < instants_.size() && instants_[record] <= motion_.t() + rounding * time_.record)
      ++record;
    return record;
  }

  double loop_seconds() const { return former_loop_seconds_ + processor_seconds() - loop_start_; }

  bool keep_checkpoint() {
    return keeper_.keep([&] {
      results::Checkpoint checkpoint;
      checkpoint.spent = {.setup_seconds = result_.setup_seconds,
                          .loop_seconds = loop_seconds(),
                          .steps = static_cast<int>(motion_.steps())};
      checkpoint.state = now_;
      checkpoint.place.now = now_.t;
      checkpoint.record = energy_.record();
      checkpoint.recorder = recorder_->position();
      checkpoint.progress = {motion_.memory(), limit_};
      return checkpoint;
    });
  }

  /// The step never grows again: each change costs a little accuracy.
  void limit_step(const step::Spectrum& spectrum) {
    const double stable = spectrum.stable_step();
    limit_ = std::min(limit_, time_.step > 0 ? std::min(time_.step, stable) : time_.safety * stable);
  }

  void tell_steps(const step::Spectrum& spectrum) const {
    const double record = (time_.end - time_.begin) / equal_records_;
    const int steps = whole(record / limit_);
    const step::Spectrum free{spectrum.stiffness, 0, spectrum.damping};
    watch_.say(
        fmt::format("{}: stable step {:.4g}{}; steps of {:.4g}, {} a record, {} in all", model_.study.name,
                    spectrum.stable_step(),
                    spectrum.contact > 0 ? fmt::format(" ({:.4g} without contact)", free.stable_step()) : "",
                    record / steps, steps, std::int64_t{steps} * equal_records_));
  }

  void go_to(double end) {
    const double before = processor_seconds();
    const double begin = now_.t;
    const auto steps_before = motion_.steps();
    const results::ExplicitProgress start{motion_.memory(), limit_};
    if (!advance(end))
      return interrupt();
    auto next = motion_.state();
    results::Attempt attempt{begin, next.t, 0, next.motion.u.allFinite(), processor_seconds() - before};
    step::StepReport report;
    report.outcome = attempt.accepted ? step::Outcome::converged : step::Outcome::not_finite;
    try {
      if (attempt.accepted)
        accept(std::move(next), attempt, report, end == time_.end);
      else
        give_up(next, attempt, report);
    } catch (const WriteError& error) {
      motion_.restore(start.motion);
      limit_ = start.limit;
      return break_off(error);
    }
    const auto steps = static_cast<double>(motion_.steps() - steps_before);
    watch_.progress({model_.study.name, attempt.end, time_.begin, time_.end, (attempt.end - begin) / steps, 0,
                     points_in_contact(now_), 0, attempt.accepted, &report});
  }

  /// In steps that the contact as it stands allows. False when the run was asked to stop.
  bool advance(double end) {
    while (motion_.t() < end) {
      if (watch_.stop())
        return false;
      limit_step(motion_.spectrum());
      const double left = end - motion_.t();
      const int steps = whole(left / limit_);
      const int part = std::min(steps, steps_between_estimates);
      motion_.advance(part == steps ? end : motion_.t() + left * part / steps, part);
      tell_within(end);
    }
    return true;
  }

  /// Once a second: the state that is told of is copied.
  void tell_within(double end) {
    const auto now = std::chrono::steady_clock::now();
    if (now - told_ < std::chrono::seconds(1))
      return;
    told_ = now;
    Progress progress{model_.study.name,
                      end,
                      time_.begin,
                      time_.end,
                      end - now_.t,
                      0,
                      points_in_contact(motion_.state()),
                      0,
                      false};
    progress.within = true;
    watch_.within(progress);
  }

  void accept(step::State next, const results::Attempt& attempt, const step::StepReport& report, bool last) {
    recorder_->step(now_, next, attempt, report, last);
    const auto energy = motion_.energy();
    recorder_->energy(next.t, energy);
    energy_.note(next.t, energy);
    now_ = std::move(next);
    ++recorded_;
    if (keeper_.is_due(recorded_, now_.t, attempt.end - attempt.begin) && !last)
      keep_checkpoint();
  }

  void give_up(const step::State& reached, const results::Attempt& attempt, const step::StepReport& report) {
    recorder_->failed(attempt, report);
    failure_ = {attempt.begin, attempt.end, 0, report, {}, {"a shorter time.step", "a smaller time.safety"}};
    failure_->not_finite = step::first_not_finite(model_, attempt.end, reached, report);
    result_.status = Status::not_converged;
    result_.message =
        fmt::format("displacements grew beyond all bounds between t = {:g} and {:g}; the first that is "
                    "not finite: {}",
                    attempt.begin, attempt.end, failure_->not_finite);
  }

  void interrupt() {
    result_.status = Status::interrupted;
    result_.message = fmt::format("interrupted at t = {:g}", now_.t);
  }

  /// What the disk did not take is not part of the run: it stands at its last whole record.
  void break_off(const WriteError& error) {
    recorder_->take_back(now_);
    result_.status = Status::interrupted;
    result_.message = fmt::format("{} after t = {:g}", error.what(), now_.t);
    broken_off_ = true;
  }

  /// Of a run that was broken off because it could not write, the summary may be lost too.
  void finish() {
    try {
      result_.checks = recorder_->finish({result_.status, result_.message, result_.setup_seconds,
                                          result_.loop_seconds, result_.steps, 0, 0, failure_});
    } catch (const WriteError&) {
      if (!broken_off_)
        throw;
    }
  }

  const model::Model& model_;
  const study::TimeStepping& time_;
  RunContext& course_;
  const Watch& watch_;
  step::ExplicitMotion motion_;
  CheckpointWriter keeper_;
  EnergyWatch energy_;
  std::optional<results::Recorder> recorder_; // after the step is known to be good
  step::State now_;
  int equal_records_ = 1;
  std::vector<double> instants_; ///< of the records, the begin first; stops among the equal ones
  double limit_ = INFINITY;      ///< of the step
  int recorded_ = 0;             ///< records so far
  std::chrono::steady_clock::time_point told_ = std::chrono::steady_clock::now();
  double loop_start_ = 0;
  double former_loop_seconds_ = 0;
  bool broken_off_ = false;
  std::optional<results::Failure> failure_;
  RunResult result_;
};

} // namespace

RunResult run_explicit(const model::Model& model, RunContext& course, const Watch& watch,
                       double setup_start) {
  return ExplicitLoop(model, course, watch).run(setup_start);
}

} // namespace rubato::run
