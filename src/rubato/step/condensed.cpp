// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/condensed.hpp"

#include "rubato/core/tolerances.hpp"
#include "rubato/step/cycle_detector.hpp"
#include "rubato/step/projected_cg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rubato::step {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Surface residual at which free bodies take a new base, whose full residual decides. Counted from one that
/// carries the contact forces, the rest of the way loses no digits.
constexpr double nearly_balanced = 1e-6;

/// Nothing of an attempt before is seen but the storage it left.
CondensedScratch& scratch_of(EffectiveSystem& system, const time::Scheme& scheme, int components) {
  if (!system.scratch)
    system.scratch = std::make_shared<CondensedScratch>(*system.compliance, scheme.contact_weight(),
                                                        components, system.has_free_bodies);
  system.scratch->forget();
  return *system.scratch;
}

} // namespace

CondensedScratch::CondensedScratch(Compliance& compliance, double force_weight, int components,
                                   bool free_bodies)
    : surface(compliance), points(compliance, surface, force_weight),
      guess(compliance, force_weight, components, free_bodies) {}

void CondensedScratch::forget() {
  surface.forget();
  points.forget();
  guess.guess.forget();
}

bool can_condense(const Model& model, const EffectiveSystem& system) {
  return system.compliance && !model.zones.empty() && !finds_forces(model);
}

std::optional<Start> other_start(const Model& model, const EffectiveSystem& system) {
  const bool guesses =
      can_condense(model, system) && std::ranges::any_of(model.zones, [](const contact::Zone& zone) {
        return zone.settings.status.by == study::Iteration::newton;
      });
  if (!guesses)
    return std::nullopt;
  return starts_from_guess(model, Start::usual) ? Start::last_step : Start::guess;
}

Condensed::Condensed(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                     const State& committed, double t, const ContactEvaluator& side, Pulse& pulse)
    : model_(model), scheme_(scheme), system_(system), side_(side), pulse_(pulse),
      equilibrium_(model, scheme, system, committed, t),
      scratch_(scratch_of(system, scheme, model.dofs.components)), scale_(committed.force_scale),
      reach_(reach_of(model, system)), surface_(model, scheme, system) {}

StepReport Condensed::run(State& trial, const Held& held) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  if (!started_) {
    start_from(trial);
    if (!equilibrium_.residual().allFinite())
      return ended(Outcome::not_finite, held);
    side_.start_iterations();
    if (starts_from_guess(model_, side_.variant().start))
      predict_contact(trial, held);
    if (pulse_.stopped())
      return ended(Outcome::interrupted, held);
  }
  if (!system_.has_free_bodies)
    side_.start_iterations();
  reach_.start();
  CycleDetector cycle;
  for (int iteration = 0; iteration <= model_.study.newton.max_iterations; ++iteration) {
    evaluate_contact(trial, held, iteration);
    if (!force().allFinite())
      return ended(Outcome::not_finite, held);
    if (iteration > 0 && settled(trial, held)) {
      surface_.move_bulk(trial);
      const auto force = contact_force();
      if (in_equilibrium(trial, held, force)) {
        equilibrium_.finish(force, trial);
        side_.finish(held, now(), trial);
        return ended(Outcome::converged, held);
      }
      if (!equilibrium_.residual().allFinite())
        return ended(Outcome::not_finite, held);
      if (system_.has_free_bodies)
        surface_.start_from(trial.motion, equilibrium_.residual(), Condensed::force());
      else
        start_from(trial);
    }
    const bool may_cycle = iteration > 0 && report_.status_changes > 0;
    const auto part = may_cycle ? cycle.part_of_next(now(), force().norm()) : 1.0;
    if (!part)
      return ended(Outcome::cycling, held);
    if (iteration == model_.study.newton.max_iterations)
      break;
    const double residual = iteration > 0 ? report_.residual : std::numeric_limits<double>::quiet_NaN();
    if (!pulse_.beat(static_cast<int>(scratch_.in_contact.size()), residual))
      return ended(Outcome::interrupted, held);
    if (!iterate(trial, held, *part))
      return ended(Outcome::singular_matrix, held);
    ++report_.iterations;
  }
  return ended(Outcome::too_many_iterations, held);
}

StepReport Condensed::ended(Outcome outcome, const Held& held) {
  report_.outcome = outcome;
  if (report_.failed()) {
    report_.worst = equilibrium_.residual().allFinite() ? worst_on_surface() : equilibrium_.worst();
    if (outcome != Outcome::not_finite)
      side_.name_unmet(held, report_.iterations > 0 ? &previous() : nullptr, now(), report_);
    name_unbalance(report_);
  }
  return report_;
}

std::vector<WorstNode> Condensed::worst_on_surface() const {
  std::vector<mesh::NodeIndex> nodes;
  for (const int dof : system_.compliance->dof_of_position())
    nodes.push_back(model_.node_of(dof));
  const VectorXd left = scheme_.contact_weight() * (force() - surface_.applied);
  return worst_nodes(left, nodes, surface_scale());
}

void Condensed::start_from(const State& trial) {
  started_ = true;
  surface_.start_from(trial.motion, equilibrium_);
}

void Condensed::predict_contact(State& trial, const Held& held) {
  step::predict_contact({model_, system_, side_, held, equilibrium_, pulse_}, surface_, reach_,
                        scratch_.guess, now(), trial);
  // Only points that are guessed are followed, and not those that take part of others' multipliers.
  measured_ = std::ranges::all_of(held, [](const HeldZone& zone) { return zone.status.empty(); }) &&
              std::ranges::none_of(model_.zones, &contact::Zone::shares_multipliers);
}

void Condensed::evaluate_contact(const State& trial, const Held& held, int iteration) {
  if (!measured_) {
    std::swap(previous(), now());
    side_.measure(trial, held, now());
  }
  measured_ = false;
  if (iteration > 0)
    side_.renew_status(held, previous(), now());
  collect_forces(held);
}

void Condensed::collect_forces(const Held& held) {
  scratch_.in_contact.clear();
  scratch_.force.setZero(surface_.free.size());
  const auto& position = system_.compliance->position_of_dof();
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto law = side_.law_of(z, held);
    for (std::size_t i = 0; i < now().status[z].size(); ++i) {
      const auto status = now().status[z][i];
      if (status == Status::open)
        continue;
      const auto& point = now().points[z][i];
      const Eigen::Vector3d force = contact::force_of(law, i, point, status);
      scratch_.in_contact.push_back({z, i, status, force});
      point.kinematics->stencil.scatter(force, model_.dofs, position, scratch_.force);
    }
  }
}

bool Condensed::settled(const State& trial, const Held& held) {
  side_.collect_restless(held, previous(), now(), report_);
  measure_surface();
  const bool stalled = surface_stall_.stalls(report_.residual);
  if (!surface_.consistent || report_.status_changes > 0 || !side_.settled(held, previous(), now()))
    return false;
  const double wanted =
      system_.has_free_bodies ? std::max(nearly_balanced, report_.tolerance) : report_.tolerance;
  const bool balanced = report_.residual <= wanted || (stalled && surface_within_rounding(trial, held));
  // A free body that is let go of hops anew, by its whole weight; the border's place is off by a trace of a
  // face.
  return balanced && (system_.has_free_bodies || !side_.release_strays());
}

/// A force follows the gap by the stiffness there, and gaps are differences of places; friction follows
/// slips, which are differences of moves. Both contain the free motion, of which contact takes most back.
bool Condensed::surface_within_rounding(const State& trial, const Held& held) const {
  const auto& dofs = system_.compliance->dof_of_position();
  double reach = 0;
  double moved = 0;
  for (const int dof : dofs) {
    const auto& place = model_.mesh.points[static_cast<std::size_t>(model_.node_of(dof))];
    reach = std::max(reach, place.lpNorm<Eigen::Infinity>() + std::abs(trial.motion.u[dof]));
    moved = std::max(moved, std::abs(trial.motion.u[dof]));
  }
  const double far = surface_.free.lpNorm<Eigen::Infinity>();
  const auto stiffness = contact_stiffness(model_, system_, side_.friction_stiffness(held, now()));
  const double allowed = report_.tolerance * surface_scale();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const double left = scheme_.contact_weight() *
                        std::abs(force()[static_cast<Index>(i)] - surface_.applied[static_cast<Index>(i)]);
    const double level =
        stiffness.by_place[dofs[i]] * (reach + far) + stiffness.by_move[dofs[i]] * (moved + far);
    if (left > std::max(allowed, tolerances.rounding() * level))
      return false;
  }
  return true;
}

/// Until the bulk has been solved for, forces are measured by what they were measured by in the last step.
double Condensed::surface_scale() const {
  return std::max(scale_, scheme_.contact_weight() * force().lpNorm<Eigen::Infinity>());
}

void Condensed::measure_surface() {
  Index worst = 0;
  const double largest =
      force().size() > 0 ? scheme_.contact_weight() * (force() - surface_.applied).cwiseAbs().maxCoeff(&worst)
                         : 0.0;
  report_.residual = largest == 0 ? 0 : largest / surface_scale();
  if (force().size() > 0)
    report_.worst_node =
        model_.node_of(system_.compliance->dof_of_position()[static_cast<std::size_t>(worst)]);
}

/// How the points in contact answer, in their linear system.
void Condensed::linearise(const State& trial, const Held& held) {
  auto& points = scratch_.points;
  points.clear();
  for (const auto& point : scratch_.in_contact) {
    side_.differentiate(trial, held, point.zone, point.index, now());
    contact::factor_response(side_.law_of(point.zone, held), point.index,
                             now().points[point.zone][point.index], point.status, model_.dofs,
                             points.add(point.zone, point.index, shares_of(point.zone, point.index)));
  }
  add_open_points(held);
}

/// Those that share multipliers with others.
void Condensed::add_open_points(const Held& held) {
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    if (!model_.zones[z].shares_multipliers())
      continue;
    const auto law = side_.law_of(z, held);
    for (std::size_t i = 0; i < now().status[z].size(); ++i)
      if (now().status[z][i] == Status::open)
        scratch_.points.add_open(shares_of(z, i), contact::open_equations(law, i, now().points[z][i]));
  }
}

/// None of a point that owns its multipliers.
std::span<const MultiplierShare> Condensed::shares_of(std::size_t z, std::size_t index) {
  const auto& zone = model_.zones[z];
  auto& shares = scratch_.shares;
  shares.clear();
  if (!zone.shares_multipliers())
    return shares;
  const auto& point = zone.points[index];
  for (std::size_t j = 0; j < point.multipliers.size(); ++j)
    shares.push_back({model_.multiplier_offsets[z] + point.multipliers[j] * zone.multipliers_per_node(),
                      point.multiplier_shape[j]});
  return shares;
}

bool Condensed::iterate(State& trial, const Held& held, double part) {
  linearise(trial, held);
  const auto change =
      system_.has_free_bodies
          ? scratch_.points.solve(surface_.free - surface_.moved, surface_.beyond_carried(force()))
          : scratch_.points.solve(surface_.free - surface_.moved, force());
  if (!change)
    return false;
  VectorXd next = force();
  scratch_.points.add_force(*change, next);
  VectorXd move = -surface_.moved;
  std::swap(surface_.applied, next);
  surface_.move(trial);
  move += surface_.moved;
  if (system_.has_free_bodies)
    part *= reach_.part_of(part * move);
  surface_.consistent = part == 1;
  if (!surface_.consistent) {
    surface_.applied = next + part * (surface_.applied - next);
    surface_.moved -= (1 - part) * move;
    surface_.place(trial);
  }
  correct_own_multipliers(*change, move, part, trial);
  correct_shared_multipliers(*change, part, trial);
  return surface_.moved.allFinite();
}

/// `moved`: how far the whole change moves the surface. Open points have no multipliers in the end.
void Condensed::correct_own_multipliers(const InterfaceNewtonSystem::Change& change, const VectorXd& moved,
                                        double part, State& trial) const {
  const auto of_point = [&](std::size_t z, int count, std::size_t i) {
    return trial.zones[z].multipliers.segment(model_.zones[z].points[i].node_position * count, count);
  };
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const int count = model_.zones[z].owns_multipliers() ? model_.zones[z].multipliers_per_node() : 0;
    for (std::size_t i = 0; count > 0 && i < now().status[z].size(); ++i)
      if (now().status[z][i] == Status::open)
        of_point(z, count, i) *= 1 - part;
  }
  const auto& points = scratch_.points;
  for (const auto& point : points.points())
    if (const int count = point.response.multipliers(); count > 0 && point.shares.empty())
      of_point(point.zone, count, point.index) += part * points.multipliers_of(point, change, moved);
}

void Condensed::correct_shared_multipliers(const InterfaceNewtonSystem::Change& change, double part,
                                           State& trial) const {
  scratch_.points.for_each_shared(change, [&](int multiplier, double by) {
    const auto after = std::ranges::upper_bound(model_.multiplier_offsets, multiplier);
    const auto zone = static_cast<std::size_t>(after - model_.multiplier_offsets.begin()) - 1;
    trial.zones[zone].multipliers[multiplier - model_.multiplier_offsets[zone]] += part * by;
  });
}

ContactForce Condensed::contact_force() const {
  ContactForce force(surface_.base.u.size());
  for (const auto& point : scratch_.in_contact) {
    const auto& stencil = now().points[point.zone][point.index].kinematics->stencil;
    force.for_zone(model_.zones[point.zone],
                   [&](VectorXd& part) { stencil.scatter(point.force, model_.dofs, part); });
  }
  return force;
}

bool Condensed::within_rounding(const State& trial, const Held& held) const {
  const auto stiffness = contact_stiffness(model_, system_, side_.friction_stiffness(held, now()));
  return equilibrium_.within_rounding(trial.motion, stiffness, surface_.free.lpNorm<Eigen::Infinity>(),
                                      report_.tolerance);
}

bool Condensed::in_equilibrium(const State& trial, const Held& held, const ContactForce& force) {
  equilibrium_.evaluate(trial.motion, force);
  equilibrium_.measure(trial.motion, force, report_);
  scale_ = equilibrium_.scale();
  const double wanted = wanted_residual(system_, report_.tolerance);
  unbalance_grew_ = unbalance_grew_ || report_.residual >= last_unbalance_;
  last_unbalance_ = report_.residual;
  if (report_.residual <= wanted || (report_.residual <= report_.tolerance && unbalance_grew_))
    return true;
  if (!bulk_stall_.stalls(report_.residual) || !within_rounding(trial, held))
    return false;
  report_.rounding = report_.residual;
  return true;
}

} // namespace rubato::step
