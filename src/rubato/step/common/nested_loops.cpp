// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/nested_loops.hpp"

#include "rubato/contact/frozen_frame.hpp"
#include "rubato/core/tolerances.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace rubato::step {
namespace {

using contact::PointEvaluation;
using Eigen::VectorXd;
using model::Model;
using study::Iteration;

/// How settled a geometry should be that the zones want by Newton but a loop found.
constexpr double newton_like = 1e-8;
/// Rounds to get there.
constexpr int newton_like_rounds = 30;
/// Rounds that a point may go from face to face before it is frozen between two of them.
constexpr int patience = 8;
/// Rounds of a zone's own loop that a point may go to and fro between two faces before it is frozen there.
constexpr int own_patience = 5;

/// The loop of one level: zones may differ in whether they have it and how strict they are.
struct Loop {
  bool exists = false;
  double tolerance = 1;
  double last_tolerance = 1; ///< of the last round
  int max_rounds = 1;
  bool sums_up = false; ///< whether in the last round all changes to come count

  bool settles(double change, int round) const {
    return change <= (round == max_rounds ? last_tolerance : tolerance);
  }
  /// What is compared with the tolerance of a round.
  double measure(double change, double change_before, int round) const {
    return round == max_rounds && sums_up ? std::max(change, further_changes(change, change_before)) : change;
  }
};

using LevelOfZone = study::Level study::ContactZone::*;

/// Whether this attempt loops a level that the zone wants by Newton.
bool loops_instead(const contact::Zone& zone, LevelOfZone level, const RetrySettings& variant) {
  return variant.geometry_by_loop && level == &study::ContactZone::geometry &&
         zone.settings.geometry.by == Iteration::newton;
}

/// Geometry that is held has nothing to follow.
bool loops(const contact::Zone& zone, LevelOfZone level, const RetrySettings& variant) {
  if (zone.holds_geometry() && level == &study::ContactZone::geometry)
    return false;
  if (variant.status_by_newton && level == &study::ContactZone::status)
    return false;
  return (zone.settings.*level).by == Iteration::fixed_point || loops_instead(zone, level, variant);
}

/// Where `newton_like` cannot be reached, the zone's own tolerance has to do.
Loop loop_of(const Model& model, LevelOfZone level, const RetrySettings& variant) {
  Loop loop;
  for (const auto& zone : model.zones) {
    if (!loops(zone, level, variant))
      continue;
    const auto& settings = zone.settings.*level;
    const bool instead = loops_instead(zone, level, variant);
    loop.exists = true;
    loop.sums_up = loop.sums_up || instead;
    loop.tolerance = std::min(loop.tolerance, instead ? newton_like : settings.tolerance);
    loop.last_tolerance = std::min(loop.last_tolerance, settings.tolerance);
    loop.max_rounds = std::max(loop.max_rounds, instead ? newton_like_rounds : settings.max_loops);
  }
  return loop;
}

class NestedLoops {
public:
  NestedLoops(const Model& model, const ContactEvaluator& side, const Solve& solve, const State& committed,
              State& trial)
      : model_(model), side_(side), solve_(solve), committed_(committed), trial_(trial),
        held_(model.zones.size()), former_faces_(model.zones.size()), between_(model.zones.size()) {}

  StepReport run() {
    pressures_ = hold_friction_pressures();
    settle_geometry();
    report_.rounds = std::move(rounds_);
    report_.iterations = iterations_;
    return report_;
  }

private:
  /// Whether the zone iterates this level by a loop.
  bool loops(std::size_t zone, LevelOfZone level) const {
    return step::loops(model_.zones[zone], level, side_.variant());
  }

  bool loops(LevelOfZone level) const { return loop_of(model_, level, side_.variant()).exists; }

  void settle_geometry() {
    const auto loop = loop_of(model_, &study::ContactZone::geometry, side_.variant());
    double change_before = 0;
    for (int round = 1; round <= loop.max_rounds; ++round) {
      const VectorXd before = trial_.motion.u;
      const int spent = iterations_;
      hold_frames(round);
      settle_friction();
      if (!report_.converged() || !loop.exists)
        return;
      const double moved = round > 1 ? relative_move(before) : 0.0;
      const double change = loop.measure(moved, std::exchange(change_before, moved), round);
      const bool settled = round > 1 && loop.settles(change, round);
      rounds_.push_back({LoopLevel::geometry, round, iterations_ - spent, moved, settled});
      if (settled)
        return;
      report_.unmet = {{Criterion::geometry_loop, -1, moved_most(before),
                        round > 1 ? change : std::numeric_limits<double>::infinity(), loop.last_tolerance}};
    }
    report_.outcome = Outcome::geometry_unsettled;
  }

  void settle_friction() {
    const auto loop = loop_of(model_, &study::ContactZone::threshold, side_.variant());
    for (int round = 1; round <= loop.max_rounds; ++round) {
      const int spent = iterations_;
      settle_status();
      if (!report_.converged() || !loop.exists)
        return;
      const auto before = std::move(pressures_);
      pressures_ = hold_friction_pressures();
      const double change = relative_change(before, pressures_);
      const bool settled = loop.settles(change, round);
      rounds_.push_back({LoopLevel::friction, round, iterations_ - spent, change, settled});
      if (settled)
        return;
      report_.unmet = {most_changed(before, change, loop.last_tolerance)};
    }
    report_.outcome = Outcome::friction_unsettled;
  }

  void settle_status() {
    const auto loop = loop_of(model_, &study::ContactZone::status, side_.variant());
    hold_status();
    for (int round = 1; round <= loop.max_rounds; ++round) {
      auto report = solve_(trial_, held_);
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
    name_status_changes(report_);
    report_.outcome = Outcome::status_unsettled;
  }

  void hold_frames(int round) {
    if (!loops(&study::ContactZone::geometry))
      return;
    const Frozen before = std::exchange(held_, released());
    auto here = side_.at(trial_, held_);
    for (std::size_t z = 0; z < held_.size(); ++z) {
      if (!loops(z, &study::ContactZone::geometry))
        continue;
      held_[z].frames = contact::with_frozen_frames(std::move(here.points[z]));
      const bool instead = loops_instead(model_.zones[z], &study::ContactZone::geometry, side_.variant());
      if (round > (instead ? patience : own_patience))
        hold_between(before[z].frames, z, instead);
      former_faces_[z] = faces_of(before[z].frames);
    }
  }

  static std::vector<int> faces_of(const std::vector<PointEvaluation>& frames) {
    std::vector<int> faces;
    std::ranges::transform(frames, std::back_inserter(faces),
                           [](const PointEvaluation& point) { return point.pair.master_face; });
    return faces;
  }

  Frozen released() const {
    Frozen frozen = held_;
    for (auto& zone : frozen)
      zone.frames.clear();
    return frozen;
  }

  /// Where two faces make an edge, a point can be pushed off each of them onto the other, and at the border
  /// of the surface off it and back. Frozen between the faces, or on the border, once, it stays there. A
  /// zone's own loop follows points that go on from face to face: only those that come back are frozen.
  void hold_between(const std::vector<PointEvaluation>& before, std::size_t zone, bool all_that_move) {
    auto& between = between_[zone];
    between.resize(before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      auto& now = held_[zone].frames[i];
      const bool moved = before[i].pair.master_face != now.pair.master_face;
      if (!between[i] && moved && (all_that_move || former_faces_[zone][i] == now.pair.master_face))
        between[i] = place_between(before[i], now);
      if (between[i])
        now = *between[i];
    }
  }

  static PointEvaluation place_between(const PointEvaluation& before, const PointEvaluation& now) {
    PointEvaluation place = now.kinematics ? now : before;
    if (before.kinematics && now.kinematics)
      place.kinematics = contact::frozen_between(*before.kinematics, *now.kinematics);
    return place;
  }

  /// The friction pressures that are frozen from here on, zone after zone.
  std::vector<double> hold_friction_pressures() {
    if (!loops(&study::ContactZone::threshold))
      return {};
    const auto here = side_.at(trial_, held_);
    std::vector<double> all;
    for (std::size_t z = 0; z < held_.size(); ++z) {
      if (!loops(z, &study::ContactZone::threshold))
        continue;
      held_[z].thresholds =
          contact::friction_pressures(side_.law_of(z, held_), here.points[z], here.status[z]);
      all.insert(all.end(), held_[z].thresholds.begin(), held_[z].thresholds.end());
    }
    return all;
  }

  void hold_status() {
    if (!loops(&study::ContactZone::status))
      return;
    for (auto& zone : held_)
      zone.status.clear();
    const auto here = side_.at(trial_, held_);
    for (std::size_t z = 0; z < held_.size(); ++z)
      if (loops(z, &study::ContactZone::status))
        held_[z].status = here.status[z];
  }

  /// Holds the statuses that the end of the round calls for, and names the points that changed.
  void take_wanted_status() {
    const auto here = side_.at(trial_, held_);
    for (std::size_t z = 0; z < held_.size(); ++z) {
      if (!loops(z, &study::ContactZone::status))
        continue;
      auto wanted = contact::wanted_status(side_.law_of(z, held_), here.points[z]);
      for (std::size_t i = 0; i < wanted.size(); ++i)
        if (wanted[i] != held_[z].status[i]) {
          ++report_.status_changes;
          report_.changing_points.push_back(
              {static_cast<int>(z), model_.zones[z].points[i].nodes.front(), held_[z].status[i], wanted[i]});
        }
      held_[z].status = wanted;
      trial_.zones[z].status = std::move(wanted);
    }
  }

  /// How far a round moved the bodies, as part of how far they had come in this step; 0 where rounding of the
  /// places moves them as far. In a step in which nothing goes on both are what the residual's test leaves.
  double relative_move(const VectorXd& before) const {
    const double moved = (trial_.motion.u - before).lpNorm<Eigen::Infinity>();
    const double size = (before - committed_.motion.u).lpNorm<Eigen::Infinity>();
    const double left = model_.study.newton.residual * before.lpNorm<Eigen::Infinity>();
    return moved <= tolerances.rounding() * reach() ? 0.0 : moved / std::max(size, left);
  }

  /// The largest coordinate of a contact surface.
  double reach() const {
    double largest = 0;
    for (const auto& zone : model_.zones)
      for (const auto* surface : {&zone.master, &zone.slave})
        for (const auto node : surface->nodes)
          largest =
              std::max(largest, model_.mesh.points[static_cast<std::size_t>(node)].lpNorm<Eigen::Infinity>());
    return largest;
  }

  /// The point whose friction pressure a round changed most.
  Unmet most_changed(const std::vector<double>& before, double change, double allowed) const {
    Unmet worst{Criterion::friction_loop, -1, -1, change, allowed};
    double largest = -1;
    std::size_t at = 0;
    for (std::size_t z = 0; z < held_.size(); ++z)
      for (std::size_t i = 0; loops(z, &study::ContactZone::threshold) && i < held_[z].thresholds.size();
           ++i, ++at)
        if (const double here = std::abs(pressures_[at] - before[at]); here > largest) {
          largest = here;
          worst.zone = static_cast<int>(z);
          worst.node = model_.zones[z].points[i].nodes.front();
        }
    return worst;
  }

  mesh::NodeIndex moved_most(const VectorXd& before) const {
    Eigen::Index dof = 0;
    (trial_.motion.u - before).cwiseAbs().maxCoeff(&dof);
    return model_.node_of(static_cast<int>(dof));
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
  const ContactEvaluator& side_;
  const Solve& solve_;
  const State& committed_;
  State& trial_;
  Frozen held_;
  std::vector<std::vector<int>> former_faces_; ///< of the round before the last one, zone by zone
  /// Points frozen between two faces, zone by zone; empty while there is none.
  std::vector<std::vector<std::optional<PointEvaluation>>> between_;
  StepReport report_;
  std::vector<LoopRound> rounds_;
  /// Friction pressures as frozen: a new frame starts with those of the last one.
  std::vector<double> pressures_;
  int iterations_ = 0;
};

} // namespace

double further_changes(double change, double change_before) {
  if (change == 0)
    return 0;
  const double ratio = change / change_before;
  return ratio < 1 ? change * ratio / (1 - ratio) : std::numeric_limits<double>::infinity();
}

StepReport solve_levels(const Model& model, const ContactEvaluator& side, const Solve& solve,
                        const State& committed, State& trial) {
  return NestedLoops(model, side, solve, committed, trial).run();
}

} // namespace rubato::step
