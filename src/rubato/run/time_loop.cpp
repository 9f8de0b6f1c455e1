// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/time_loop.hpp"

#include "rubato/core/writing.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/results/recorder.hpp"
#include "rubato/run/advice.hpp"
#include "rubato/run/checkpoints.hpp"
#include "rubato/run/explicit_loop.hpp"
#include "rubato/run/failure.hpp"
#include "rubato/run/loop_parts.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/finiteness.hpp"
#include "rubato/step/start.hpp"
#include "rubato/step/system_cache.hpp"
#include "rubato/time/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace rubato::run {
namespace {

/// The end of another run goes on only on the same unknowns and contact points.
void check_fits(const model::Model& model, const step::State& end) {
  const auto same_zone = [](const contact::Zone& zone, const contact::ZoneState& state) {
    return zone.points.size() == state.status.size() && zone.multiplier_count() == state.multipliers.size();
  };
  if (end.motion.u.size() == model.dofs.dof_count && std::ranges::equal(model.zones, end.zones, same_zone))
    return;
  throw InputError(
      {fault_at("time.start.from",
                fmt::format("run '{}' cannot start from the end of run '{}': that one has another mesh or "
                            "other contact zones",
                            model.study.name, model.study.time.start_run))});
}

step::State first_state(const model::Model& model, const time::Scheme& scheme, const step::State* previous) {
  const auto& settings = model.study.time;
  if (settings.start == study::StartKind::from_run) {
    if (previous == nullptr)
      throw std::invalid_argument("a study that starts from another run needs the end of that run");
    check_fits(model, *previous);
    return step::continued_state(model, scheme, *previous, settings.begin);
  }
  return step::initial_state(model, scheme, settings.begin,
                             settings.start != study::StartKind::at_rest_unloaded);
}

class Loop {
public:
  Loop(const model::Model& model, RunContext& course, const Watch& watch, const step::State* previous)
      : model_(model), course_(course), watch_(watch), scheme_(time::make_scheme(model.study.time)),
        systems_(model, scheme_, [this](std::size_t bytes) { tell_memory(bytes); }),
        committed_(course.from ? course.from->state : first_state(model, scheme_, previous)),
        control_(model.study.time, committed_.t), end_(time::instants_of(model.study.time).back()),
        account_(model, scheme_, committed_), keeper_(model.study, course, watch),
        energy_(model.study.name, watch, course.from ? course.from->record : step::EnergyRecord()) {
    if (course.from)
      go_on(*course.from);
  }

  RunResult run(double setup_start) {
    if (!control_.finished())
      tell_solver();
    start_recording();
    result_.setup_seconds += processor_seconds() - setup_start;
    loop_start_ = processor_seconds();
    while (!control_.finished() && result_.status == Status::complete) {
      if (watch_.stop())
        interrupt();
      else
        try_step();
    }
    result_.loop_seconds = loop_seconds();
    if (result_.status != Status::not_converged && keeper_.keeps_end())
      result_.kept = keep_checkpoint();
    energy_.tell();
    result_.energy = energy_.record();
    result_.end = committed_;
    finish();
    return std::move(result_);
  }

private:
  void go_on(const results::Checkpoint& from) {
    check_fits(model_, committed_);
    control_.go_on(from.place);
    account_ = step::EnergyAccount(model_, scheme_, from.energy, from.overlaps);
    result_.steps = from.spent.steps;
    result_.iterations = from.spent.iterations;
    result_.cuts = from.spent.cuts;
    result_.setup_seconds = from.spent.setup_seconds;
    former_loop_seconds_ = from.spent.loop_seconds;
  }

  void start_recording() {
    if (course_.from) {
      recorder_.emplace(model_, course_.folder, course_.from->recorder, committed_);
      recorder_->needs_memory(factor_bytes_);
      return;
    }
    take_folder(course_, model_.study.name, watch_);
    recorder_.emplace(model_, course_.folder);
    recorder_->needs_memory(factor_bytes_);
    recorder_->start(committed_);
    recorder_->energy(committed_.t, account_.ledger());
  }

  double loop_seconds() const { return former_loop_seconds_ + processor_seconds() - loop_start_; }

  bool keep_checkpoint() {
    return keeper_.keep([&] {
      results::Checkpoint checkpoint;
      checkpoint.spent = {.setup_seconds = result_.setup_seconds,
                          .loop_seconds = loop_seconds(),
                          .steps = result_.steps,
                          .iterations = result_.iterations,
                          .cuts = result_.cuts};
      checkpoint.state = committed_;
      checkpoint.place = control_.place();
      checkpoint.energy = account_.ledger();
      checkpoint.overlaps = account_.overlaps();
      checkpoint.record = energy_.record();
      checkpoint.recorder = recorder_->position();
      return checkpoint;
    });
  }

  /// Throws InputError when the deck wants what the matrix doesn't allow.
  void tell_solver() {
    const auto& system = systems_.of(control_.length());
    if (model_.study.solver == study::Solver::condensed && !system.compliance)
      throw InputError("solver: found condensed, but the effective matrix is not positive definite without "
                       "contact; expected auto or full");
    tell_scheme();
    watch_.say(fmt::format("{}: solver {}", model_.study.name, step::solver_of(model_, system)));
  }

  /// Factors of other step lengths need the same.
  void tell_memory(std::size_t bytes) {
    if (factor_bytes_ == 0 && bytes > 0)
      watch_.say(fmt::format("{}: factoring the matrix takes {} of memory ({} are free)", model_.study.name,
                             linalg::memory_text(bytes), linalg::memory_text(linalg::available_memory())));
    factor_bytes_ = std::max(factor_bytes_, bytes);
  }

  void tell_scheme() {
    const auto& settings = model_.study.time;
    const auto name = std::ranges::find(time::all_schemes(), settings.scheme, &time::SchemeEntry::kind)->name;
    const bool massless = settings.contact_mass == study::ContactMass::redistributed;
    watch_.say(fmt::format("{}: scheme {}{}", model_.study.name, name,
                           massless ? ", contact surfaces without mass" : ""));
    if (!course_.from && feeds_on_contact(model_, scheme_))
      watch_.warn(fmt::format("{}: {} without damping gains energy where exact contact opens and closes; "
                              "moreau_jean doesn't, hht with alpha: -0.1 hardly",
                              model_.study.name, name));
  }

  /// `where`: in which step.
  void interrupt(const std::string& where = "") {
    result_.status = Status::interrupted;
    result_.message = fmt::format("interrupted at t = {:g}{}", committed_.t, where);
  }

  /// Says where a step stands. Whether it may go on.
  bool goes_on(const results::Attempt& attempt, const step::Beat& beat) {
    Progress progress{
        model_.study.name, attempt.end,         model_.study.time.begin, end_, attempt.end - attempt.begin,
        beat.iterations,   beat.contact_points, attempt.cut_level,       false};
    progress.within = true;
    progress.residual = beat.residual;
    watch_.within(progress);
    return !watch_.stop();
  }

  /// What the disk did not take is not part of the run: it stands at its last whole step.
  void break_off(const WriteError& error) {
    recorder_->take_back(committed_);
    result_.status = Status::interrupted;
    result_.message = fmt::format("{} after t = {:g}", error.what(), committed_.t);
    broken_off_ = true;
  }

  /// Of a run that was broken off because it could not write, the summary may be lost too.
  void finish() {
    try {
      result_.checks =
          recorder_->finish({result_.status, result_.message, result_.setup_seconds, result_.loop_seconds,
                             result_.steps, result_.iterations, result_.cuts, failure_});
    } catch (const WriteError&) {
      if (!broken_off_)
        throw;
    }
  }

  void try_step() {
    const double before = processor_seconds();
    results::Attempt attempt{control_.now(), control_.target(), control_.level(), false, 0};
    step::State trial;
    const auto report =
        step::advance(model_, scheme_, systems_.of(control_.length()), committed_, attempt.end, trial,
                      [&](const step::Beat& beat) { return goes_on(attempt, beat); });
    if (report.outcome == step::Outcome::interrupted)
      return interrupt(fmt::format(", in the step to t = {:g}", attempt.end));
    attempt.accepted = report.converged();
    attempt.seconds = processor_seconds() - before;
    try {
      if (attempt.accepted)
        accept(trial, attempt, report);
      else
        reject(trial, attempt, report);
    } catch (const WriteError& error) {
      return break_off(error);
    }
    watch_.progress({model_.study.name, attempt.end, model_.study.time.begin, end_,
                     attempt.end - attempt.begin, report.iterations, points_in_contact(committed_),
                     attempt.cut_level, attempt.accepted, &report});
  }

  void accept(step::State& trial, const results::Attempt& attempt, const step::StepReport& report) {
    auto account = account_;
    account.enter(committed_, trial);
    recorder_->step(committed_, trial, attempt, report, attempt.end == end_);
    recorder_->energy(trial.t, account.ledger());
    // Written; from here on nothing fails.
    account_ = account;
    control_.accept();
    ++result_.steps;
    result_.iterations += report.iterations;
    energy_.note(trial.t, account_.ledger());
    tell_rounding(trial.t, report);
    committed_ = std::move(trial);
    if (keeper_.is_due(result_.steps, committed_.t, attempt.end - attempt.begin) && !control_.finished())
      keep_checkpoint();
  }

  /// Once a run.
  void tell_rounding(double t, const step::StepReport& report) {
    if (report.rounding == 0 || told_rounding_)
      return;
    told_rounding_ = true;
    watch_.say(
        fmt::format("{}: at t = {:g} rounding of the forces leaves a residual of {:.1e} (wanted {:.0e}); "
                    "the step counts as converged, and so do later ones",
                    model_.study.name, t, report.rounding, report.tolerance));
  }

  /// A run that ends here is kept as it was before the attempt: resumed with other means, it makes it again.
  void reject(const step::State& trial, const results::Attempt& attempt, const step::StepReport& report) {
    const bool goes_on = control_.cut();
    if (!goes_on && keeper_.keeps_end())
      result_.kept = keep_checkpoint();
    recorder_->failed(attempt, report);
    result_.iterations += report.iterations;
    if (goes_on) {
      ++result_.cuts;
      return;
    }
    result_.status = Status::not_converged;
    failure_ = {attempt.begin, attempt.end, attempt.cut_level, report, {}, {}};
    failure_->advice = advice(model_, scheme_, *failure_);
    if (report.outcome == step::Outcome::not_finite)
      failure_->not_finite = step::first_not_finite(model_, attempt.end, trial, report);
    result_.message = explain(model_, *failure_);
  }

  const model::Model& model_;
  RunContext& course_;
  const Watch& watch_;
  time::Scheme scheme_;
  step::SystemCache systems_;
  step::State committed_;
  std::optional<results::Recorder> recorder_; // once nothing can be refused any more: that leaves no folder
  time::StepControl control_;
  double end_;
  step::EnergyAccount account_;
  CheckpointWriter keeper_;
  EnergyWatch energy_;
  std::size_t factor_bytes_ = 0; ///< what the factor of the matrix needs; 0: nothing was factored
  double loop_start_ = 0;
  double former_loop_seconds_ = 0;
  bool broken_off_ = false;
  bool told_rounding_ = false;
  std::optional<results::Failure> failure_;
  RunResult result_;
};

} // namespace

bool RunResult::checks_hold() const {
  return std::ranges::all_of(checks, &results::CheckResult::holds);
}

RunResult run_study(const study::Study& study, const std::filesystem::path& folder, const Watch& watch,
                    const step::State* previous, Begin begin) {
  const double start = processor_seconds();
  auto mesh = model::load_mesh(study.mesh);
  RunContext course{folder,
                    results::fingerprint(mesh),
                    previous != nullptr ? results::fingerprint(*previous) : 0,
                    {},
                    results::FolderClaim(folder)};
  if (begin == Begin::unless_done)
    if (auto finished = unchanged_run(study, course)) {
      watch.say(
          fmt::format("{}: complete and unchanged in {}, not computed again", study.name, folder.string()));
      return std::move(*finished);
    }
  if (begin == Begin::resumed) {
    course.from = find_checkpoint(study, course);
    if (auto finished = finished_run(study, course)) {
      watch.say(fmt::format("{}: complete already", study.name));
      return std::move(*finished);
    }
    watch.say(course.from ? fmt::format("{}: goes on from t = {:g}", study.name, course.from->state.t)
                          : fmt::format("{}: no checkpoint in {}, starts at its beginning", study.name,
                                        folder.string()));
  }
  const auto model = model::build_model(study, std::move(mesh));
  watch.say(fmt::format("{}: {} nodes, {} unknowns, {} contact points", study.name, model.mesh.node_count(),
                        model.reduction.unknown_count(), [&] {
                          std::size_t points = 0;
                          for (const auto& zone : model.zones)
                            points += zone.points.size();
                          return points;
                        }()));
  for (const auto& note : model.notes)
    watch.warn(fmt::format("{}: {}", study.name, note));
  if (study::is_explicit(study.time.scheme))
    return run_explicit(model, course, watch, start);
  return Loop(model, course, watch, previous).run(start);
}

} // namespace rubato::run
