// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/levels.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

using contact::Status;
using deck::Iteration;
using Eigen::VectorXd;
using model::Model;

/// The loop of one level: zones may differ in whether they have it and how strict they are.
struct Loop {
  bool exists = false;
  double tolerance = 1;
  int max_rounds = 1;
};

Loop loop_of(const Model& model, deck::Level deck::ContactZone::*level) {
  Loop loop;
  for (const auto& zone : model.zones) {
    const auto& settings = zone.settings.*level;
    if (settings.by == Iteration::newton)
      continue;
    loop.exists = true;
    loop.tolerance = std::min(loop.tolerance, settings.tolerance);
    loop.max_rounds = std::max(loop.max_rounds, settings.max_loops);
  }
  return loop;
}

class Levels {
public:
  Levels(const Model& model, Newton& newton, const State& committed, State& trial)
      : model_(model), newton_(newton), committed_(committed), trial_(trial), held_(model.zones.size()) {}

  StepReport run() {
    pressures_ = hold_thresholds();
    settle_geometry();
    report_.rounds = std::move(rounds_);
    report_.iterations = iterations_;
    return report_;
  }

private:
  /// Whether the zone iterates this level by a loop.
  bool loops(std::size_t zone, deck::Level deck::ContactZone::*level) const {
    return (model_.zones[zone].settings.*level).by == Iteration::fixed_point;
  }

  void settle_geometry() {
    const auto loop = loop_of(model_, &deck::ContactZone::geometry);
    for (int round = 1; round <= loop.max_rounds; ++round) {
      const VectorXd before = trial_.motion.u;
      const int spent = iterations_;
      hold_frames();
      settle_friction();
      if (!report_.converged() || !loop.exists)
        return;
      const double moved = (trial_.motion.u - before).lpNorm<Eigen::Infinity>();
      const double size = (before - committed_.motion.u).lpNorm<Eigen::Infinity>();
      const bool settled = round > 1 && moved <= loop.tolerance * size;
      rounds_.push_back({LoopLevel::geometry, round, iterations_ - spent,
                         round > 1 && size > 0 ? moved / size : 0.0, settled});
      if (settled)
        return;
    }
    report_.outcome = Outcome::geometry_unsettled;
  }

  void settle_friction() {
    const auto loop = loop_of(model_, &deck::ContactZone::threshold);
    for (int round = 1; round <= loop.max_rounds; ++round) {
      const int spent = iterations_;
      settle_status();
      if (!report_.converged() || !loop.exists)
        return;
      const auto before = std::move(pressures_);
      pressures_ = hold_thresholds();
      const double change = relative_change(before, pressures_);
      const bool settled = change <= loop.tolerance;
      rounds_.push_back({LoopLevel::friction, round, iterations_ - spent, change, settled});
      if (settled)
        return;
    }
    report_.outcome = Outcome::friction_unsettled;
  }

  void settle_status() {
    const auto loop = loop_of(model_, &deck::ContactZone::status);
    hold_status();
    for (int round = 1; round <= loop.max_rounds; ++round) {
      auto report = newton_.run(trial_, held_);
      iterations_ += report.iterations;
      const int spent = report.iterations;
      report_ = std::move(report);
      if (!report_.converged() || !loop.exists)
        return;
      take_wanted_status();
      const bool settled = report_.status_changes == 0;
      rounds_.push_back(
          {LoopLevel::status, round, spent, static_cast<double>(report_.status_changes), settled});
      if (settled)
        return;
    }
    report_.outcome = Outcome::status_unsettled;
  }

  void hold_frames() {
    for (auto& zone : held_)
      zone.frames.clear();
    auto here = newton_.contact_at(trial_, held_);
    for (std::size_t z = 0; z < held_.size(); ++z)
      if (loops(z, &deck::ContactZone::geometry))
        held_[z].frames = contact::with_held_frames(std::move(here.points[z]));
  }

  /// The friction pressures that are held from here on, zone after zone.
  std::vector<double> hold_thresholds() {
    const auto here = newton_.contact_at(trial_, held_);
    std::vector<double> all;
    for (std::size_t z = 0; z < held_.size(); ++z) {
      if (!loops(z, &deck::ContactZone::threshold))
        continue;
      held_[z].thresholds =
          contact::friction_pressures(newton_.law_of(z, held_), here.points[z], here.status[z]);
      all.insert(all.end(), held_[z].thresholds.begin(), held_[z].thresholds.end());
    }
    return all;
  }

  void hold_status() {
    const auto here = newton_.contact_at(trial_, held_);
    for (std::size_t z = 0; z < held_.size(); ++z)
      if (loops(z, &deck::ContactZone::status))
        held_[z].status = here.status[z];
  }

  /// Holds the statuses that the end of the round calls for, and names the points that changed.
  void take_wanted_status() {
    const auto here = newton_.contact_at(trial_, held_);
    for (std::size_t z = 0; z < held_.size(); ++z) {
      if (!loops(z, &deck::ContactZone::status))
        continue;
      auto wanted = contact::wanted_status(newton_.law_of(z, held_), here.points[z]);
      for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i] != held_[z].status[i]) {
          ++report_.status_changes;
          report_.restless.push_back({static_cast<int>(z), model_.zones[z].points[i].nodes.front()});
        }
      held_[z].status = wanted;
      trial_.zones[z].status = std::move(wanted);
    }
  }

  static double relative_change(const std::vector<double>& before, const std::vector<double>& now) {
    double change = 0;
    double largest = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      change = std::max(change, std::abs(now[i] - before[i]));
      largest = std::max(largest, std::abs(now[i]));
    }
    return change == 0 ? 0.0 : change / largest;
  }

  const Model& model_;
  Newton& newton_;
  const State& committed_;
  State& trial_;
  Held held_;
  StepReport report_;
  std::vector<LoopRound> rounds_;
  /// Friction pressures as held: a new frame starts with those of the last one.
  std::vector<double> pressures_;
  int iterations_ = 0;
};

} // namespace

StepReport solve_levels(const Model& model, Newton& newton, const State& committed, State& trial) {
  return Levels(model, newton, committed, trial).run();
}

} // namespace rubato::step
