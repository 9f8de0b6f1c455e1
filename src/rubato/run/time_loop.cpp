// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/processor_time.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/recorder.hpp"
#include "rubato/run/advice.hpp"
#include "rubato/run/checkpoints.hpp"
#include "rubato/run/failure.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/run/watches.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/told_state.hpp"
#include "rubato/study/damping.hpp"
#include "rubato/study/schemes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

namespace rubato::run {
namespace {

using simulation::AcceptedStep;
using simulation::Attempt;
using simulation::RejectedStep;
using simulation::StepResult;
using simulation::Verdict;

/// Makes the folder of a run that begins anew, and says where former results in it go.
void take_folder(RunContext& course, const std::string& run, const Watch& watch) {
  course.claim.value().make();
  if (results::holds_run(course.folder))
    watch.say(fmt::format("{}: the former results in {} move into {}", run, course.folder.string(),
                          (course.folder / results::former_folder).string()));
}

std::string warning_of(const model::Model& model, const std::string& note) {
  return fmt::format("{}: {}", model.study.name, note);
}

/// By Rayleigh's part of the stiffness, or as modes.
bool is_damped_by_stiffness(const study::Study& study) {
  return study.modal_damping || std::ranges::any_of(study.materials, [](const study::Material& material) {
           return study::rayleigh_coefficients(material).stiffness != 0;
         });
}

/// When a run was asked for.
struct Asked {
  double processor = processor_seconds();
  std::chrono::steady_clock::time_point clock = std::chrono::steady_clock::now();
};

/// A simulation that is recorded.
class Run {
public:
  Run(const model::Model& model, RunContext& course, const Watch& watch, const step::State* previous,
      const Asked& asked)
      : model_(model), course_(course), asked_(asked), watch_(with_records(watch)),
        simulation_(model, {.previous = previous,
                            .memento = course.from ? &course.from->memento : nullptr,
                            .tell_memory = [this](std::size_t bytes) { tell_memory(bytes); }}),
        keeper_(model.study, course, watch_),
        watches_(model, watch_, course.from ? course.from->record : step::EnergyRecord(),
                 course.from ? course.from->plausibility : std::vector<results::Plausibility>()) {
    if (!course.from)
      return;
    records_ = course.from->recorder.steps;
    result_.setup_seconds = course.from->setup_seconds;
    former_loop_seconds_ = course.from->loop_seconds;
  }
  Run(const Run&) = delete; // the simulation tells this one
  Run& operator=(const Run&) = delete;

  RunResult go() {
    tell_method();
    start_recording();
    result_.setup_seconds += processor_seconds() - asked_.processor;
    watch_.room(0);
    loop_start_ = processor_seconds();
    sent_before_loop_ = ranks().bytes_sent();
    while (!simulation_.finished() && result_.status == Status::complete) {
      if (is_to_stop())
        interrupt();
      else
        try_step();
    }
    result_.loop_seconds = loop_seconds();
    if (result_.status != Status::not_converged && keeper_.keeps_end())
      result_.kept = keep_checkpoint();
    take_counters();
    result_.plausibility = watches_.tell();
    result_.energy = watches_.energy();
    result_.end = *step::ToldState(model_, simulation_.state());
    finish();
    return std::move(result_);
  }

private:
  const std::string& name() const { return model_.study.name; }
  const Ranks& ranks() const { return model_.ranks; }
  bool is_to_stop() const { return ranks().of_first(watch_.stop()); }

  /// Warnings are recorded, too.
  Watch with_records(const Watch& watch) {
    auto recording = watch;
    recording.warn = [this, warn = watch.warn](const std::string& text) {
      warn(text);
      if (recorder_)
        recorder_->warn(text);
      else
        early_warnings_.push_back(text);
    };
    return recording;
  }

  void start_recording() {
    const step::ToldState start(model_, simulation_.state());
    ranks().first_does([&] { make_recorder(*start); });
    simulation_.observe({.accepted = [this](const AcceptedStep& step) { record(step); },
                         .rejected = [this](const RejectedStep& step) { record(step); },
                         .take_back =
                             [this](const step::State&) {
                               if (recorder_)
                                 recorder_->take_back();
                             }});
  }

  void make_recorder(const step::State& start) {
    if (course_.from)
      recorder_.emplace(model_, course_.folder, course_.from->recorder);
    else {
      take_folder(course_, name(), watch_);
      recorder_.emplace(model_, course_.folder);
    }
    for (const auto& note : model_.notes)
      recorder_->warn(warning_of(model_, note));
    for (const auto& warning : early_warnings_)
      recorder_->warn(warning);
    if (factor_bytes_ > 0)
      recorder_->needs_memory(factor_bytes_);
    if (const auto method = simulation_.method(); !method.empty())
      recorder_->takes_steps_by(method);
    if (!course_.from) {
      recorder_->start(start);
      recorder_->energy(start.t, simulation_.energy());
    }
  }

  void record(const AcceptedStep& step) {
    const step::ToldState now(model_, step.now);
    ranks().first_does([&] {
      recorder_->step(step.before, *now, step.attempt, step.report, step.last);
      recorder_->energy(step.now.t, step.energy);
    });
    watches_.note(step.before, step.now, *now, step.energy, step.last);
  }

  /// A run that ends here is kept as it was before the attempt: resumed with other means, it makes it again.
  void record(const RejectedStep& step) {
    if (step.final && keeper_.keeps_failure())
      result_.kept = keep_checkpoint();
    ranks().first_does([&] { recorder_->failed(step.attempt, step.report); });
    if (step.final)
      failure_ = failure_of(model_, step);
  }

  double loop_seconds() const { return former_loop_seconds_ + processor_seconds() - loop_start_; }

  /// All ranks have a part of the memento.
  bool keep_checkpoint() {
    auto memento = simulation_.memento();
    return ranks().of_first(ranks().is_first() && write_checkpoint(std::move(memento)));
  }

  bool write_checkpoint(simulation::Memento memento) {
    return keeper_.keep([&] {
      results::Checkpoint checkpoint;
      checkpoint.setup_seconds = result_.setup_seconds;
      checkpoint.loop_seconds = loop_seconds();
      checkpoint.memento = std::move(memento);
      checkpoint.record = watches_.energy();
      checkpoint.plausibility = watches_.checks();
      checkpoint.recorder = recorder_->position();
      return checkpoint;
    });
  }

  /// Factors of other step lengths need the same.
  void tell_memory(std::size_t bytes) {
    if (bytes > 0)
      watch_.room(bytes);
    if (factor_bytes_ == 0 && bytes > 0)
      watch_.say(fmt::format("{}: {} takes {} of memory ({} are free)", name(),
                             model_.study.solver == study::Solver::iterative ? "iterating with the matrix"
                                                                             : "factoring the matrix",
                             linalg::memory_text(bytes), linalg::memory_text(linalg::available_memory())));
    factor_bytes_ = std::max(factor_bytes_, bytes);
  }

  void tell_method() const {
    if (!study::is_explicit(model_.study.time.scheme) && !simulation_.finished())
      tell_scheme();
    if (const auto method = simulation_.method(); !method.empty())
      watch_.say(fmt::format("{}: {}", name(), method));
    if (!domain::is_linear(model_.bulk) && is_damped_by_stiffness(model_.study))
      watch_.say(
          fmt::format("{}: bodies are nonlinear, their damping is made of the stiffness that they begin "
                      "with",
                      name()));
  }

  void tell_scheme() const {
    const auto& settings = model_.study.time;
    const auto scheme = study::entry_of(settings.scheme).name;
    const bool massless = settings.contact_mass == study::ContactMass::redistributed;
    watch_.say(
        fmt::format("{}: scheme {}{}", name(), scheme, massless ? ", contact surfaces without mass" : ""));
    if (!course_.from && feeds_on_contact(model_, time::make_scheme(settings)))
      watch_.warn(
          fmt::format("{}: {} without damping gains energy where exact contact opens and closes; expected "
                      "moreau_jean (no gain), or where nothing hits hht with alpha: -0.1 (little)",
                      name(), scheme));
  }

  /// `where`: in which step.
  void interrupt(const std::string& where = "") {
    result_.status = Status::interrupted;
    result_.message = fmt::format("interrupted at t = {:g}{}", simulation_.state().t, where);
  }

  /// What every progress of an attempt says.
  Progress progress_of(const Attempt& attempt) const {
    return {name(),
            attempt.end,
            model_.study.time.begin,
            simulation_.end(),
            (attempt.end - attempt.begin) / std::max(1, attempt.steps),
            0,
            0,
            attempt.cut_level,
            attempt.accepted};
  }

  /// Says where a step stands. Whether it may go on.
  bool goes_on(const simulation::Moment& moment) const {
    auto progress = progress_of(moment.attempt);
    progress.iterations = moment.progress.iterations;
    progress.contact_points = moment.progress.contact_points;
    progress.residual = moment.progress.residual;
    progress.within = true;
    watch_.within(progress);
    return !is_to_stop();
  }

  void try_step() {
    try {
      const auto result =
          simulation_.attempt([this](const simulation::Moment& moment) { return goes_on(moment); });
      if (result.verdict == Verdict::interrupted)
        return interrupt(
            result.attempt.steps == 0 ? fmt::format(", in the step to t = {:g}", result.attempt.end) : "");
      if (result.accepted())
        go_on(result);
      else if (result.verdict == Verdict::not_converged)
        fail();
      tell_progress(result);
    } catch (const StoppedWhileWaiting&) {
      interrupt();
    } catch (const WriteError& error) {
      break_off(error);
    } catch (const InputError& error) {
      refuse(error);
      throw;
    }
  }

  void go_on(const StepResult& result) {
    ++records_;
    const double t = simulation_.state().t;
    watches_.note_energy(t, result.energy);
    tell_rounding(t, result.report);
    tell_instability(t, result.report);
    if (keeper_.is_due(records_, t, result.attempt.end - result.attempt.begin) && !simulation_.finished())
      keep_checkpoint();
  }

  /// Once a run.
  void tell_rounding(double t, const step::StepReport& report) {
    if (report.rounding == 0 || told_rounding_)
      return;
    told_rounding_ = true;
    watch_.say(fmt::format(
        "{}: at t = {:g} rounding leaves a force of {:.1e} unbalanced, {:.1e} of the largest load or "
        "reaction (wanted {:.0e}); the step counts as converged, and so do later ones",
        name(), t, report.unbalanced_force, report.rounding, report.tolerance));
  }

  /// Once a run.
  void tell_instability(double t, const step::StepReport& report) {
    if (!report.indefinite || std::exchange(told_instability_, true))
      return;
    watch_.warn(fmt::format(
        "{}: in the step to t = {:g} the effective matrix without contact is not positive "
        "definite: bodies may buckle there, or be past a limit load{}",
        name(), t,
        report.unstable_directions == 0
            ? ""
            : fmt::format(" ({} direction{} in which the state is not stable)", report.unstable_directions,
                          report.unstable_directions == 1 ? "" : "s")));
  }

  void fail() {
    result_.status = Status::not_converged;
    result_.message = explain(model_, failure_.value());
  }

  void tell_progress(const StepResult& result) const {
    auto progress = progress_of(result.attempt);
    progress.iterations = result.report.iterations;
    progress.contact_points = step::points_in_contact(simulation_.state());
    progress.report = &result.report;
    watch_.progress(progress);
  }

  /// What the disk did not take is not part of the run: it stands at its last whole step.
  void break_off(const WriteError& error) {
    result_.status = Status::interrupted;
    result_.message = fmt::format("{} after t = {:g}", error.what(), simulation_.state().t);
    broken_off_ = true;
  }

  /// A value of the study turns out to be none on the way, as an expression at some instant.
  void refuse(const InputError& error) {
    result_.status = Status::interrupted;
    result_.message =
        fmt::format("{}; the last whole step ends at t = {:g}", error.what(), simulation_.state().t);
    result_.loop_seconds = loop_seconds();
    take_counters();
    finish();
  }

  void take_counters() {
    const auto& counters = simulation_.counters();
    result_.steps = counters.steps;
    result_.iterations = counters.iterations;
    result_.cuts = counters.cuts;
  }

  /// Of a run that was broken off because it could not write, the summary may be lost too.
  void finish() {
    result_.elapsed_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - asked_.clock).count();
    const double sent = ranks().bytes_sent() - sent_before_loop_;
    const step::ToldState end(model_, simulation_.state());
    try {
      ranks().first_does([&] {
        result_.checks =
            recorder_->finish({result_.status, result_.message, result_.setup_seconds, result_.loop_seconds,
                               result_.elapsed_seconds, result_.steps, result_.iterations, result_.cuts,
                               failure_, result_.plausibility, sent},
                              *end);
      });
    } catch (const WriteError&) {
      if (!broken_off_)
        throw;
    }
  }

  const model::Model& model_;
  RunContext& course_;
  Asked asked_;
  std::vector<std::string> early_warnings_; ///< from before anything is recorded
  Watch watch_;
  std::size_t factor_bytes_ = 0; ///< what the factor of the matrix needs; 0: nothing was factored
  simulation::Simulation simulation_;
  /// Of the first rank, once nothing can be refused any more: that leaves no folder.
  std::optional<results::Recorder> recorder_;
  CheckpointWriter keeper_;
  Watches watches_;
  int records_ = 0; ///< so far: steps of results
  double loop_start_ = 0;
  double former_loop_seconds_ = 0;
  double sent_before_loop_ = 0;
  bool broken_off_ = false;
  bool told_rounding_ = false;
  bool told_instability_ = false;
  std::optional<results::Failure> failure_;
  RunResult result_;
};

void tell_model(const model::Model& model, const Watch& watch) {
  const auto& name = model.study.name;
  std::size_t points = 0;
  for (const auto& zone : model.zones)
    points += zone.points.size();
  watch.say(fmt::format("{}: {} nodes, {} unknowns, {} contact points", name, model.mesh.node_count(),
                        model.reduction.unknown_count(), points));
  if (!model.ranks.is_alone())
    watch.say(fmt::format("{}: {} ranks of {} thread{} each", name, model.ranks.count(),
                          model.threads.count(), model.threads.count() == 1 ? "" : "s"));
  for (const auto& choice : model::chosen_sides(model.zones))
    watch.say(fmt::format("{}: {}", name, choice));
  for (const auto& note : model.notes)
    watch.warn(warning_of(model, note));
}

} // namespace

bool RunResult::checks_hold() const {
  return std::ranges::all_of(checks, &results::CheckResult::holds);
}

namespace {

RunResult run_on(mesh::Mesh mesh, const Asked& asked, const study::Study& study,
                 const std::filesystem::path& folder, const Watch& watch, const step::State* previous,
                 Begin begin, const Workers& workers) {
  RunContext course{
      folder, results::fingerprint(mesh), previous != nullptr ? results::fingerprint(*previous) : 0, {}, {}};
  workers.ranks.first_does([&] { course.claim.emplace(folder); });
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
    watch.say(course.from ? fmt::format("{}: goes on from t = {:g}", study.name, course.from->memento.state.t)
                          : fmt::format("{}: no checkpoint in {}, starts at its beginning", study.name,
                                        folder.string()));
  }
  workers.ranks.meet(); // the folder may change
  const auto model = model::build_model(study, std::move(mesh), workers);
  tell_model(model, watch);
  return Run(model, course, watch, previous, asked).go();
}

} // namespace

RunResult run_study(const study::Study& study, const std::filesystem::path& folder, const Watch& watch,
                    const step::State* previous, Begin begin, const Workers& workers) {
  const Asked now;
  return run_on(model::load_mesh(study.mesh), now, study, folder, watch, previous, begin, workers);
}

RunResult run_study(const study::Study& study, mesh::Mesh mesh, const std::filesystem::path& folder,
                    const Watch& watch, const step::State* previous, Begin begin, const Workers& workers) {
  return run_on(std::move(mesh), {}, study, folder, watch, previous, begin, workers);
}

} // namespace rubato::run
