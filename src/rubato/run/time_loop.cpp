// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/time_loop.hpp"

#include "rubato/results/recorder.hpp"
#include "rubato/run/explicit_loop.hpp"
#include "rubato/run/loop_parts.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/start.hpp"
#include "rubato/time/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace rubato::run {
namespace {

/// Effective matrices of the step lengths in use: cut steps come back to the lengths they had.
class SystemCache {
public:
  SystemCache(const model::Model& model, const time::Scheme& scheme) : model_(model), scheme_(scheme) {}

  step::EffectiveSystem& of(double length) {
    const auto known = std::ranges::find(systems_, length, &step::EffectiveSystem::step);
    if (known != systems_.end())
      return *known;
    if (systems_.size() == kept)
      systems_.erase(systems_.begin());
    return systems_.emplace_back(step::make_effective_system(model_, scheme_, length));
  }

private:
  static constexpr std::size_t kept = 4;
  const model::Model& model_;
  const time::Scheme& scheme_;
  std::vector<step::EffectiveSystem> systems_;
};

/// The end of another run goes on only on the same unknowns and contact points.
void check_fits(const model::Model& model, const step::State& end) {
  const auto same_zone = [](const contact::Zone& zone, const contact::ZoneState& state) {
    return zone.points.size() == state.status.size() && zone.multiplier_count() == state.multipliers.size();
  };
  if (end.motion.u.size() == model.dofs.dof_count && std::ranges::equal(model.zones, end.zones, same_zone))
    return;
  throw InputError(fmt::format("run '{}' cannot start from the end of run '{}': that one has another mesh or "
                               "other contact zones",
                               model.study.name, model.study.time.start_run.text),
                   model.study.time.start_run.at);
}

step::State first_state(const model::Model& model, const time::Scheme& scheme, const step::State* previous) {
  const auto& settings = model.study.time;
  if (settings.start == deck::StartKind::from_run) {
    if (previous == nullptr)
      throw std::invalid_argument("a study that starts from another run needs the end of that run");
    check_fits(model, *previous);
    return step::continued_state(model, scheme, *previous, settings.begin);
  }
  return step::initial_state(model, scheme, settings.begin,
                             settings.start != deck::StartKind::at_rest_unloaded);
}

class Loop {
public:
  Loop(const model::Model& model, const std::filesystem::path& folder, const Watch& watch,
       const step::State* previous)
      : model_(model), watch_(watch), scheme_(time::make_scheme(model.study.time)), systems_(model, scheme_),
        committed_(first_state(model, scheme_, previous)), folder_(folder),
        control_(model.study.time, committed_.t), end_(time::instants_of(model.study.time).back()) {}

  RunResult run(double setup_start) {
    tell_solver();
    recorder_.emplace(model_, folder_);
    recorder_->start(committed_);
    result_.setup_seconds = processor_seconds() - setup_start;
    const double loop_start = processor_seconds();
    while (!control_.finished() && result_.status == Status::complete) {
      if (watch_.stop())
        interrupt();
      else
        try_step();
    }
    result_.loop_seconds = processor_seconds() - loop_start;
    result_.end = committed_;
    result_.checks =
        recorder_->finish({result_.status, result_.message, result_.setup_seconds, result_.loop_seconds,
                           result_.steps, result_.iterations, result_.cuts});
    return std::move(result_);
  }

private:
  /// Throws InputError when the deck wants what the matrix doesn't allow.
  void tell_solver() {
    const auto& system = systems_.of(control_.length());
    if (model_.study.solver == deck::Solver::condensed && !system.compliance)
      throw InputError("solver: found condensed, but the effective matrix is not positive definite without "
                       "contact; expected auto or full");
    watch_.say(fmt::format("{}: solver {}", model_.study.name, step::solver_of(model_, system)));
  }

  void interrupt() {
    result_.status = Status::interrupted;
    result_.message = fmt::format("interrupted at t = {:g}", committed_.t);
  }

  void try_step() {
    const double before = processor_seconds();
    results::Attempt attempt{control_.now(), control_.target(), control_.level(), false, 0};
    step::State trial;
    const auto report =
        step::advance(model_, scheme_, systems_.of(control_.length()), committed_, attempt.end, trial);
    attempt.accepted = report.converged();
    attempt.seconds = processor_seconds() - before;
    result_.iterations += report.iterations;
    if (attempt.accepted)
      accept(trial, attempt, report);
    else
      reject(attempt, report);
    watch_.progress({model_.study.name, attempt.end, model_.study.time.begin, end_,
                     attempt.end - attempt.begin, report.iterations, points_in_contact(committed_),
                     attempt.cut_level, attempt.accepted, &report});
  }

  void accept(step::State& trial, const results::Attempt& attempt, const step::StepReport& report) {
    control_.accept();
    ++result_.steps;
    recorder_->step(committed_, trial, attempt, report, control_.finished());
    committed_ = std::move(trial);
  }

  void reject(const results::Attempt& attempt, const step::StepReport& report) {
    recorder_->failed(attempt, report);
    if (control_.cut()) {
      ++result_.cuts;
      return;
    }
    result_.status = Status::not_converged;
    result_.message = explain(model_, report, attempt.begin, attempt.end);
  }

  const model::Model& model_;
  const Watch& watch_;
  time::Scheme scheme_;
  SystemCache systems_;
  step::State committed_;
  std::filesystem::path folder_;
  std::optional<results::Recorder> recorder_; // once nothing can be refused any more: that leaves no folder
  time::StepControl control_;
  double end_;
  RunResult result_;
};

} // namespace

bool RunResult::checks_hold() const {
  return std::ranges::all_of(checks, &results::CheckResult::holds);
}

RunResult run_study(const deck::Study& study, const std::filesystem::path& folder, const Watch& watch,
                    const step::State* previous) {
  const double start = processor_seconds();
  const auto model = model::build_model(study);
  watch.say(fmt::format("{}: {} nodes, {} unknowns, {} contact points", study.name, model.mesh.node_count(),
                        model.free_dofs.size(), [&] {
                          std::size_t points = 0;
                          for (const auto& zone : model.zones)
                            points += zone.points.size();
                          return points;
                        }()));
  if (deck::is_explicit(study.time.scheme))
    return run_explicit(model, folder, watch, start);
  return Loop(model, folder, watch, previous).run(start);
}

std::string explain(const model::Model& model, const step::StepReport& report, double begin, double end) {
  auto text = fmt::format("no convergence from t = {:g} to {:g} ({}, {} iterations)", begin, end,
                          step::to_string(report.outcome), report.iterations);
  if (report.worst_node >= 0)
    text += fmt::format("; residual {:.2e} (wanted {:.0e}), largest at node {}", report.residual,
                        report.tolerance, model::node_label(model.mesh, report.worst_node));
  if (!report.restless.empty()) {
    const auto& point = report.restless.front();
    text += fmt::format("; {} contact points kept changing their status, among them {} of zone '{}'",
                        report.status_changes, model::node_label(model.mesh, point.node),
                        model.zones[static_cast<std::size_t>(point.zone)].settings.name);
  }
  return text;
}

} // namespace rubato::run
