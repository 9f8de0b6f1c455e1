// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/contact_evaluator.hpp"

#include "rubato/contact/dropped_nodes.hpp"
#include "rubato/contact/spring_friction.hpp"
#include "rubato/contact/springs.hpp"
#include "rubato/contact/velocity_frames.hpp"
#include "rubato/core/tolerances.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

using contact::PointEvaluation;
using contact::Status;
using Eigen::VectorXd;
using model::Model;

/// Penetration in edges beyond which a projection may be on any face.
constexpr double deep_in_edges = 0.5;

/// A point on the border of two faces may belong to either; its place is the same.
double move_on_master(const contact::Pair& here, const contact::Pair& there) {
  return here.master_face != there.master_face ? 0.0
                                               : (here.projection.clamped - there.projection.clamped).norm();
}

/// Obstacles have no coordinates on them, their curvature is all that a place changes.
double turn_of_normal(const PointEvaluation& here, const PointEvaluation& there) {
  return (here.kinematics->normal - there.kinematics->normal).norm();
}

/// Before the first step every point may have the status of one that touches, also where nothing faces it.
bool touches(const contact::ZoneState& zone, std::size_t point) {
  return zone.status[point] != Status::open && point < zone.outcomes.size() &&
         std::isfinite(zone.outcomes[point].gap);
}

/// What is left of a gap, of a tie of its slips as well.
double misfit_of(const contact::PointState& point, bool tied) {
  return std::max(std::abs(point.gap), tied ? point.slip.norm() : 0.0);
}

/// Counts a point that does not meet a criterion, and keeps the one that is furthest from it.
void take(std::optional<Unmet>& worst, const Unmet& found) {
  const int count = worst ? worst->count + 1 : 1;
  if (!worst || !(found.value * worst->allowed <= worst->value * found.allowed))
    worst = found;
  worst->count = count;
}

/// The statuses a solve starts with, where a point can have them.
void keep_given_status(const contact::Zone& zone, const std::vector<PointEvaluation>& points,
                       const std::vector<Status>& given, std::vector<Status>& status) {
  status.assign(points.size(), Status::open);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].kinematics && !zone.points[i].excluded)
      status[i] = given[i];
}

/// Of the last step, whatever the length of the next. At its end nodes without mass may have any velocity:
/// they swing about this one. Before the first step it is the velocity itself.
VectorXd mean_velocity(const State& state, const contact::VelocityLaw& law) {
  return state.motion.v - (1 - law.theta) * state.step * state.motion.a;
}

/// A zone has no mass on its whole slave or keeps all of it. Ties, whose points never hit, go with the
/// others.
bool is_massless(const Model& model, const contact::Zone& zone) {
  const auto& nodes = model.massless_nodes;
  return !nodes.empty() && (zone.settings.tie || std::ranges::binary_search(nodes, zone.slave.nodes.front()));
}

/// Where points that are closed stand; others have to close their gaps first.
std::vector<double> activation_gaps(const contact::ZoneState& zone) {
  std::vector<double> gaps(zone.status.size(), 0.0);
  for (std::size_t i = 0; i < zone.outcomes.size(); ++i)
    if (zone.status[i] != Status::open)
      gaps[i] = zone.outcomes[i].activation_gap;
  return gaps;
}

struct PointWithStatus {
  const PointEvaluation& point;
  Status status;
};

/// Zero of a point that is open.
Eigen::Vector3d force_of(const contact::ZoneLaw& law, std::size_t index, const PointWithStatus& at) {
  return at.status == Status::open ? Eigen::Vector3d::Zero()
                                   : contact::force_of(law, index, at.point, at.status);
}

/// Whether the change of a point's status makes a force of more than `negligible` another one. A point that
/// pressed and faces nothing now has no force to compare with.
bool is_decisive(const contact::ZoneLaw& law, std::size_t index, const PointWithStatus& before,
                 const PointWithStatus& now, double negligible) {
  const Eigen::Vector3d force = force_of(law, index, now);
  if (force_of(law, index, before).norm() <= negligible && force.norm() <= negligible)
    return false;
  return !now.point.kinematics ||
         (force - force_of(law, index, {now.point, before.status})).norm() > negligible;
}

/// Directions that friction of a point has lost are not given back in the same attempt.
void keep_fewer(const contact::FrictionDirections& found, std::size_t point, std::size_t points,
                std::vector<contact::FrictionDirections>& of_zone) {
  if (found.count == contact::FrictionDirections{}.count)
    return;
  of_zone.resize(points);
  if (found.count < of_zone[point].count)
    of_zone[point] = found;
}

} // namespace

ContactEvaluator::ContactEvaluator(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                                   const State& committed, const RetrySettings& variant)
    : model_(model), system_(system), committed_(committed), variant_(variant), coefficients_(system.zones),
      directions_(model.zones.size()) {
  for (std::size_t z = 0; z < coefficients_.size(); ++z)
    contact::scale_augmentations(model.zones[z], variant.normal_multiple, variant.tangential_multiple,
                                 coefficients_[z]);
  for (std::size_t z = 0; z < model.zones.size(); ++z) {
    touched_.push_back(contact::touched_points(model.zones[z], committed.zones[z]));
    contact::begin_step(system.discretisations[z], committed.zones[z]);
  }
  if (!scheme.nonsmooth)
    return;
  const contact::Configuration start{&model.mesh,         &model.dofs, &committed.motion.u,
                                     &committed.motion.u, committed.t, committed.t};
  contact::VelocityLaw law{system.step, scheme.beta, false};
  const VectorXd mean = model.massless_nodes.empty() ? VectorXd() : mean_velocity(committed, law);
  for (std::size_t z = 0; z < system.discretisations.size(); ++z) {
    law.massless = is_massless(model, model.zones[z]);
    const auto& velocity = law.massless ? mean : committed.motion.v;
    activation_gaps_.push_back(activation_gaps(committed.zones[z]));
    frames_.push_back(contact::velocity_frames(system.discretisations[z], start, velocity, law,
                                               activation_gaps_.back(), touched_[z]));
  }
}

contact::ZoneLaw ContactEvaluator::law_of(std::size_t zone, const Frozen& frozen) const {
  return {&model_.zones[zone],
          &coefficients_[zone],
          variant_.friction_part * model_.zones[zone].settings.friction,
          frozen[zone].thresholds,
          touched_[zone],
          directions_[zone]};
}

ContactIterate ContactEvaluator::at(const State& trial, const Frozen& frozen) const {
  ContactIterate iterate;
  evaluate(trial, frozen, iterate);
  return iterate;
}

contact::Configuration ContactEvaluator::at_end(const State& trial) const {
  return {&model_.mesh, &model_.dofs, &trial.motion.u, &committed_.motion.u, trial.t, committed_.t};
}

/// `measure` takes points of a zone whose frames move to the configuration.
template <class Measure>
void ContactEvaluator::measure_by(const Measure& measure, const State& trial, const Frozen& frozen,
                                  ContactIterate& into) const {
  const auto configuration = at_end(trial);
  into.points.resize(model_.zones.size());
  into.status.resize(model_.zones.size());
  if (std::ranges::any_of(model_.zones, contact::sticks_in_passing))
    into.u = trial.motion.u;
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto& zone = model_.zones[z];
    if (has_frozen_frames(z, frozen))
      contact::evaluate_in_frozen_frames(frames_.empty() ? frozen[z].frames : frames_[z], zone,
                                         trial.zones[z].multipliers, configuration, into.points[z]);
    else
      measure(z, configuration);
    const auto& given = frozen[z].status.empty() ? trial.zones[z].status : frozen[z].status;
    keep_given_status(zone, into.points[z], given, into.status[z]);
  }
}

void ContactEvaluator::evaluate(const State& trial, const Frozen& frozen, ContactIterate& into) const {
  const auto all = [&](std::size_t z, const auto& configuration) {
    contact::evaluate(system_.discretisations[z], trial.zones[z].multipliers, configuration, into.points[z]);
  };
  measure_by(all, trial, frozen, into);
}

void ContactEvaluator::measure(const State& trial, const Frozen& frozen, ContactIterate& into) const {
  const auto all = [&](std::size_t z, const auto& configuration) {
    contact::measure(system_.discretisations[z], trial.zones[z].multipliers, configuration, into.points[z]);
  };
  measure_by(all, trial, frozen, into);
}

void ContactEvaluator::measure(const State& trial, const Frozen& frozen,
                               std::span<const std::vector<std::size_t>> points,
                               ContactIterate& iterate) const {
  const auto some = [&](std::size_t z, const auto& configuration) {
    contact::measure(system_.discretisations[z], trial.zones[z].multipliers, configuration, points[z],
                     iterate.points[z]);
  };
  measure_by(some, trial, frozen, iterate);
}

void ContactEvaluator::differentiate(const State& trial, const Frozen& frozen, std::size_t zone,
                                     std::size_t point, ContactIterate& iterate) const {
  if (!has_frozen_frames(zone, frozen))
    contact::differentiate(model_.zones[zone], point, at_end(trial), iterate.points[zone][point]);
}

bool ContactEvaluator::is_out_of_reach(const ContactIterate& now) const {
  bool all_face = true;
  for (std::size_t z = 0; z < now.points.size(); ++z) {
    const double deep = -deep_in_edges * model_.zones[z].edge();
    for (const auto& point : now.points[z]) {
      if (point.kinematics && point.variables.gap < deep)
        return true;
      all_face = all_face && point.kinematics;
    }
  }
  return !all_face && most_are_lost(now);
}

/// Some may have slid off the master.
bool ContactEvaluator::most_are_lost(const ContactIterate& now) const {
  int touching = 0;
  int lost = 0;
  for (std::size_t z = 0; z < now.points.size(); ++z)
    for (std::size_t i = 0; i < now.points[z].size(); ++i) {
      if (!touches(committed_.zones[z], i) || model_.zones[z].points[i].excluded)
        continue;
      ++touching;
      lost += now.points[z][i].kinematics ? 0 : 1;
    }
  return 2 * lost > touching;
}

void ContactEvaluator::start_iterations() const {
  for (auto& discretisation : system_.discretisations)
    contact::forget_visits(discretisation);
}

bool ContactEvaluator::presses(const Frozen& frozen, const ContactIterate& now,
                               const contact::PointOfZone& at) const {
  const auto& point = now.points[at.zone][at.point];
  return point.kinematics && now.status[at.zone][at.point] != Status::open &&
         contact::wanted_status(point.variables, law_of(at.zone, frozen).of_point(at.point)) != Status::open;
}

void ContactEvaluator::restrict_friction(const Frozen& frozen, const ContactIterate& now) {
  for (const auto& group : model_.shared_nodes) {
    std::vector<contact::PointOfZone> pressing;
    std::vector<Eigen::Vector3d> normals;
    for (const auto& at : group)
      if (presses(frozen, now, at)) {
        pressing.push_back(at);
        normals.push_back(now.points[at.zone][at.point].kinematics->normal);
      }
    for (const auto& [zone, point] : pressing)
      keep_fewer(contact::common_directions(*now.points[zone][point].kinematics, normals), point,
                 now.points[zone].size(), directions_[zone]);
  }
}

bool ContactEvaluator::release_beyond_borders() const {
  bool any = false;
  for (auto& discretisation : system_.discretisations)
    any = contact::release_beyond_borders(discretisation) || any;
  return any;
}

void ContactEvaluator::renew_status(const Frozen& frozen, const ContactIterate& before,
                                    ContactIterate& now) const {
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    if (!frozen[z].status.empty())
      continue;
    now.status[z] = contact::wanted_status(law_of(z, frozen), now.points[z]);
    contact::keep_last_contact(law_of(z, frozen), now.points[z], before.status[z], now.status[z]);
    contact::stick_in_passing(law_of(z, frozen), {before.points[z], before.status[z], before.u},
                              {now.points[z], now.status[z], now.u}, model_.dofs, now.status[z]);
  }
}

std::vector<std::vector<double>> ContactEvaluator::friction_stiffness(const Frozen& frozen,
                                                                      const ContactIterate& now) const {
  std::vector<std::vector<double>> stiffness;
  for (std::size_t z = 0; z < now.points.size(); ++z)
    stiffness.push_back(contact::friction_stiffness(law_of(z, frozen), now.points[z], now.status[z]));
  return stiffness;
}

std::vector<std::vector<double>> ContactEvaluator::spring_stiffness(const Frozen& frozen,
                                                                    const ContactIterate& now) const {
  std::vector<std::vector<double>> stiffness;
  for (std::size_t z = 0; z < now.points.size(); ++z)
    stiffness.push_back(contact::spring_stiffness(law_of(z, frozen), now.points[z]));
  return stiffness;
}

void ContactEvaluator::collect_status_changes(const Frozen& frozen, const ContactIterate& before,
                                              const ContactIterate& now, StepReport& report) const {
  report.status_changes = 0;
  report.changing_points.clear();
  for (std::size_t z = 0; z < now.status.size(); ++z)
    for (std::size_t i = 0; frozen[z].status.empty() && i < now.status[z].size(); ++i)
      if (now.status[z][i] != before.status[z][i]) {
        ++report.status_changes;
        report.changing_points.push_back({static_cast<int>(z), model_.zones[z].points[i].nodes.front(),
                                          before.status[z][i], now.status[z][i]});
      }
}

bool ContactEvaluator::has_decisive_changes(const Frozen& frozen, const ContactIterate& before,
                                            const ContactIterate& now, double negligible) const {
  for (std::size_t z = 0; z < now.status.size(); ++z) {
    if (!frozen[z].status.empty())
      continue;
    const auto law = law_of(z, frozen);
    for (std::size_t i = 0; i < now.status[z].size(); ++i)
      if (now.status[z][i] != before.status[z][i] &&
          is_decisive(law, i, {before.points[z][i], before.status[z][i]},
                      {now.points[z][i], now.status[z][i]}, negligible))
        return true;
  }
  return false;
}

bool ContactEvaluator::settled(const Frozen& frozen, const ContactIterate& before,
                               const ContactIterate& now) const {
  return !moving_projection(frozen, before, now) && !open_gap(frozen, now);
}

void ContactEvaluator::name_unmet(const Frozen& frozen, const ContactIterate* before,
                                  const ContactIterate& now, StepReport& report) const {
  const auto add = [&](const std::optional<Unmet>& unmet) {
    if (unmet)
      report.unmet.push_back(*unmet);
  };
  add(lost_point(before, now));
  name_status_changes(report);
  if (before != nullptr)
    add(moving_projection(frozen, *before, now));
  add(open_gap(frozen, now));
}

void ContactEvaluator::finish(const Frozen& frozen, const ContactIterate& iterate, State& trial) const {
  trial.friction_force = VectorXd::Zero(trial.motion.u.size());
  trial.moved_out.clear();
  for (std::size_t z = 0; z < iterate.status.size(); ++z) {
    trial.zones[z].status = iterate.status[z];
    trial.zones[z].outcomes = contact::outcomes(law_of(z, frozen), iterate.points[z], iterate.status[z]);
  }
  contact::distribute_shared_points(model_.zones, trial.zones);
  for (std::size_t z = 0; z < iterate.status.size(); ++z) {
    contact::report_dropped_nodes(iterate.points[z], iterate.status[z], trial.zones[z]);
    contact::add_friction_force(iterate.points[z], trial.zones[z].outcomes, model_.dofs,
                                trial.friction_force);
    trial.moved_out.push_back(moved_out(z, iterate, at_end(trial)));
    trial.zones[z].lifts.resize(iterate.points[z].size());
    std::ranges::transform(iterate.points[z], trial.zones[z].lifts.begin(), &PointEvaluation::lift);
  }
  if (!frames_.empty())
    measure_places(trial);
  for (std::size_t z = 0; z < iterate.status.size(); ++z) {
    add_obstacle_work(z, iterate.points[z], trial);
    add_friction_history(z, iterate.points[z], trial);
  }
}

std::vector<double> ContactEvaluator::moved_out(std::size_t z, const ContactIterate& iterate,
                                                const contact::Configuration& configuration) const {
  std::vector<double> moved;
  const auto& before = committed_.zones[z].outcomes;
  const auto& zone = model_.zones[z];
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!(before[i].gap < contact::reach(zone)) || iterate.status[z][i] == Status::open ||
        !before[i].normal.isZero(0))
      continue;
    const auto& k = *iterate.points[z][i].kinematics;
    const Eigen::Vector3d way =
        k.stencil.sum([&](auto node) { return configuration.increment(node); }) - k.obstacle_displacement;
    moved.resize(before.size(), 0.0);
    moved[i] =
        k.normal.dot(way) + zone.offset.change(zone.points[i].place, configuration.start_t, configuration.t);
  }
  return moved;
}

/// Results tell where points are, not how fast they part.
void ContactEvaluator::measure_places(State& trial) const {
  std::vector<PointEvaluation> points;
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    contact::measure(system_.discretisations[z], trial.zones[z].multipliers, at_end(trial), points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      trial.zones[z].outcomes[i].gap = points[i].variables.gap;
      trial.zones[z].outcomes[i].slip = points[i].variables.slip;
      trial.zones[z].outcomes[i].activation_gap = activation_gaps_[z][i];
    }
  }
}

std::optional<Unmet> ContactEvaluator::moving_projection(const Frozen& frozen, const ContactIterate& before,
                                                         const ContactIterate& now) const {
  std::optional<Unmet> worst;
  for (std::size_t z = 0; z < now.points.size(); ++z)
    for (std::size_t i = 0; frozen[z].frames.empty() && i < now.points[z].size(); ++i) {
      if (now.status[z][i] == Status::open)
        continue;
      const auto& here = now.points[z][i];
      const auto& there = before.points[z][i];
      const double moved =
          model_.zones[z].obstacle ? turn_of_normal(here, there) : move_on_master(here.pair, there.pair);
      if (!(moved <= tolerances.settled_projection))
        take(worst, {Criterion::projection, static_cast<int>(z), named_node(z, i), moved,
                     tolerances.settled_projection});
    }
  return worst;
}

std::optional<Unmet> ContactEvaluator::open_gap(const Frozen& frozen, const ContactIterate& now) const {
  std::optional<Unmet> worst;
  for (std::size_t z = 0; z < now.points.size(); ++z) {
    const auto& zone = model_.zones[z];
    if (!contact::closes_gaps(zone))
      continue;
    const double allowed = tolerances.closed_gap * zone.edge();
    const auto check = [&](double gap, mesh::NodeIndex node) {
      if (!(gap <= allowed))
        take(worst, {Criterion::gap, static_cast<int>(z), node, gap, allowed});
    };
    if (!zone.points_own_multipliers) {
      const auto mean = contact::largest_mean_gap(law_of(z, frozen), now.points[z], now.status[z]);
      check(mean.value, zone.slave.nodes[static_cast<std::size_t>(mean.position)]);
      continue;
    }
    for (std::size_t i = 0; i < now.points[z].size(); ++i)
      if (now.status[z][i] != Status::open)
        check(misfit_of(now.points[z][i].variables, zone.settings.tie), named_node(z, i));
  }
  return worst;
}

/// A law of velocities has frames for the points that touch in this step only: none of the others is lost.
std::optional<Unmet> ContactEvaluator::lost_point(const ContactIterate* before,
                                                  const ContactIterate& now) const {
  std::optional<Unmet> lost;
  for (std::size_t z = 0; frames_.empty() && z < now.points.size(); ++z)
    for (std::size_t i = 0; i < now.points[z].size(); ++i) {
      const bool touched =
          touches(committed_.zones[z], i) || (before != nullptr && before->status[z][i] != Status::open);
      if (touched && !now.points[z][i].kinematics && !model_.zones[z].points[i].excluded)
        take(lost, {Criterion::point_lost, static_cast<int>(z), named_node(z, i), 1, 0});
    }
  if (lost)
    lost->value = lost->count;
  return lost;
}

mesh::NodeIndex ContactEvaluator::named_node(std::size_t zone, std::size_t point) const {
  return model_.zones[zone].points[point].nodes.front();
}

} // namespace rubato::step
