// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/condensed.hpp"

#include "rubato/contact/springs.hpp"
#include "rubato/core/tolerances.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/common/held_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rubato::step {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Model;

/// Surface residual at which free bodies take a new base, whose full residual decides. Counted from one that
/// carries the contact forces, the rest of the way loses no digits.
constexpr double nearly_balanced = 1e-6;

/// Iterations of free bodies without a look at what geometry adds along their rigid motions. Most steps need
/// no more; a look costs an iteration for each motion, of which a body in the plane has three.
constexpr int plain_iterations = 8;
constexpr int plain_iterations_of_few = 2;
constexpr Index few_motions = 3;
/// Motions of nonlinear bodies that may come no nearer before the attempt is given up for another one.
constexpr int bulk_patience = 8;
/// Iterations before the history of others counts.
constexpr int first_remembered = 1;
/// Bounds of the shift along a rigid motion, in parts of the reach.
constexpr double least_shift = 1e-6;
constexpr double most_shift = 1e-2;

NormalSolution normal_solution(const Model& model, const EffectiveSystem& system) {
  if (prediction_is_exact(model))
    return NormalSolution::projected_cg;
  return system.has_free_bodies ? NormalSolution::active_set : NormalSolution::near;
}

/// `at` becomes its place.
double largest_difference(const VectorXd& a, const VectorXd& b, Index& at) {
  double largest = -1;
  for (Index i = 0; i < a.size(); ++i)
    if (const double difference = std::abs(a[i] - b[i]); !(difference <= largest)) {
      largest = difference;
      at = i;
    }
  return largest;
}

/// Those that are followed: not with springs, which press as the gap of an iterate says, so that they let go
/// where a shift lifts them off.
FreeMotions followed_motions(const Model& model, const EffectiveSystem& system) {
  return FreeMotions(system.has_free_bodies && std::ranges::all_of(model.zones, contact::closes_gaps)
                         ? free_motions(model, *system.compliance)
                         : MatrixXd());
}

/// Nodes on faces are linearised whole: where they go slowly, they go from face to face.
bool remembers(const Model& model) {
  return std::ranges::any_of(model.zones, [](const contact::Zone& zone) { return zone.mortar.has_value(); });
}

/// Nothing of an attempt before is seen but the storage it left.
CondensedScratch& scratch_of(const Model& model, EffectiveSystem& system, const time::Scheme& scheme) {
  if (!system.scratch)
    system.scratch = std::make_shared<CondensedScratch>(*system.compliance, scheme.contact_weight(),
                                                        model.dofs.components, normal_solution(model, system),
                                                        followed_motions(model, system), remembers(model));
  system.scratch->forget();
  return *system.scratch;
}

} // namespace

CondensedScratch::CondensedScratch(Compliance& compliance, double force_weight, int components,
                                   NormalSolution how_far, FreeMotions motions, bool remembers_)
    : surface(compliance), points(compliance, surface, force_weight),
      predictor(compliance, force_weight, components, how_far), free_motions(std::move(motions)),
      remembers(remembers_) {}

void CondensedScratch::forget() {
  surface.forget();
  points.forget();
  predictor.predictor.forget();
  history.forget();
}

bool can_condense(const Model& model, const EffectiveSystem& system) {
  return system.compliance && !model.zones.empty();
}

std::optional<Start> other_start(const Model& model, const EffectiveSystem& system) {
  const bool predicts =
      can_condense(model, system) && std::ranges::any_of(model.zones, [](const contact::Zone& zone) {
        return zone.settings.status.by == study::Iteration::newton;
      });
  const bool usual = starts_from_prediction(model, Start::usual);
  const auto other = usual ? Start::last_step : Start::predicted;
  return predicts && starts_from_prediction(model, other) != usual ? std::optional(other) : std::nullopt;
}

Condensed::Condensed(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                     const State& committed, double t, ContactEvaluator& side, Progress& progress)
    : model_(model), scheme_(scheme), system_(system), committed_(committed), side_(side),
      progress_(progress), equilibrium_(model, scheme, system, committed, t),
      scratch_(scratch_of(model, system, scheme)), scale_(committed.force_scale),
      reach_(reach_of(model, system)), force_at_base_(committed.motion.u.size()),
      surface_(model, scheme, system) {
  if (model.domain.is_linear())
    return;
  bulk_.emplace(model, scheme, system, committed, t, Factored::yes, [this](Held held) {
    return springs_of_contact(model_, started_ ? now() : side_.at(committed_, Frozen(model_.zones.size())),
                              system_.diagonal, held);
  });
  if (side_.variant().hurries)
    bulk_->hurry(bulk_patience, false);
}

std::optional<Outcome> Condensed::start(State& trial, const Frozen& frozen) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  scratch_.history.forget();
  // A method that predicts whatever the start does so in every round of loops.
  if (!started_ || starts_from_prediction(model_, Start::last_step))
    if (const auto outcome = begin(trial, frozen))
      return outcome;
  if (!system_.has_free_bodies)
    side_.start_iterations();
  reach_.start();
  return std::nullopt;
}

std::optional<Outcome> Condensed::begin(State& trial, const Frozen& frozen) {
  // A base may carry forces; a prediction counts whole ones.
  if (bulk_ && !started_)
    start_ahead(trial);
  if (bulk_ && bulk_->starts_indefinite())
    return Outcome::indefinite;
  if (bulk_ && !started_)
    started_ = true;
  else if (!started_ || bases_carry_forces())
    start_from(trial);
  if (!equilibrium_.residual().allFinite() || !surface_.free.allFinite())
    return Outcome::not_finite;
  side_.start_iterations();
  if (starts_from_prediction(model_, side_.variant().start))
    predict_contact(trial, frozen);
  return progress_.stopped() ? std::optional(Outcome::interrupted) : std::nullopt;
}

/// The bulk is solved for; where that leaves too much, the iterations go on from there.
std::optional<Outcome> Condensed::close(State& trial, const Frozen& frozen) {
  surface_.move_bulk(trial);
  const auto force = contact_force();
  if (in_equilibrium(trial, frozen, force)) {
    equilibrium_.finish(force, trial);
    side_.finish(frozen, now(), trial);
    trial.indefinite = bulk_ && bulk_->is_indefinite();
    return Outcome::converged;
  }
  if (bulk_)
    return go_on_from(trial, frozen, force);
  if (!equilibrium_.residual().allFinite())
    return Outcome::not_finite;
  if (bases_carry_forces())
    surface_.start_from(trial.motion, equilibrium_.residual(), Condensed::force());
  else
    start_from(trial);
  scratch_.history.forget();
  return std::nullopt;
}

/// Those of free bodies lose no digits then. With springs by tables nothing else would be a fixed point: a
/// base is solved with their slopes, what contact adds to it with those of the factor.
bool Condensed::bases_carry_forces() const {
  return system_.has_free_bodies || !system_.slopes.empty();
}

void Condensed::start_from(const State& trial) {
  started_ = true;
  surface_.start_from(trial.motion, equilibrium_);
}

void Condensed::predict_contact(State& trial, const Frozen& frozen) {
  step::predict_contact({model_, system_, side_, frozen, equilibrium_, progress_}, surface_, reach_,
                        scratch_.predictor, now(), trial);
  // Only points that are predicted are followed, and not those that take part of others' multipliers.
  measured_ = std::ranges::all_of(frozen, [](const FrozenZone& zone) { return zone.status.empty(); }) &&
              std::ranges::none_of(model_.zones, &contact::Zone::shares_multipliers);
}

void Condensed::evaluate(const State& trial, const Frozen& frozen, int iteration) {
  if (!measured_) {
    std::swap(previous(), now());
    side_.measure(trial, frozen, now());
  }
  measured_ = false;
  if (iteration > 0)
    side_.renew_status(frozen, previous(), now());
  else
    side_.restrict_friction(frozen, now());
  collect_forces(frozen);
}

void Condensed::collect_forces(const Frozen& frozen) {
  scratch_.in_contact.clear();
  scratch_.force.setZero(surface_.free.size());
  const auto& interface_dof = system_.compliance->interface_dof_of_dof();
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto law = side_.law_of(z, frozen);
    for (std::size_t i = 0; i < now().status[z].size(); ++i) {
      const auto status = now().status[z][i];
      if (status == Status::open)
        continue;
      const auto& point = now().points[z][i];
      const Eigen::Vector3d force = contact::force_of(law, i, point, status);
      scratch_.in_contact.push_back({z, i, status, force});
      point.kinematics->stencil.scatter(force, model_.dofs, interface_dof, scratch_.force);
    }
  }
}

bool Condensed::is_settled(const State& trial, const Frozen& frozen) {
  side_.collect_status_changes(frozen, previous(), now(), report_);
  measure_surface();
  const bool stalled = surface_stall_.stalls(report_.residual);
  if (!surface_.consistent ||
      (report_.status_changes > 0 &&
       side_.has_decisive_changes(frozen, previous(), now(), report_.tolerance * surface_scale())) ||
      !side_.settled(frozen, previous(), now()))
    return false;
  const double wanted =
      system_.has_free_bodies ? std::max(nearly_balanced, report_.tolerance) : report_.tolerance;
  const bool balanced = report_.residual <= wanted || (stalled && surface_within_rounding(trial, frozen));
  // A free body that is let go of hops anew, by its whole weight; the border's place is off by a trace of a
  // face.
  return balanced && (system_.has_free_bodies || !side_.release_beyond_borders());
}

/// A force follows the gap by the stiffness there, and gaps are differences of places; friction follows
/// slips, which are differences of moves. Both contain the free motion, of which contact takes most back.
bool Condensed::surface_within_rounding(const State& trial, const Frozen& frozen) const {
  const auto& dofs = system_.compliance->dof_of_interface_dof();
  double reach = 0;
  double moved = 0;
  for (const int dof : dofs) {
    const auto& place = model_.mesh.points[static_cast<std::size_t>(model_.node_of(dof))];
    reach = std::max(reach, place.lpNorm<Eigen::Infinity>() + std::abs(trial.motion.u[dof]));
    moved = std::max(moved, std::abs(trial.motion.u[dof]));
  }
  const double far = surface_.free.lpNorm<Eigen::Infinity>();
  const auto stiffness = contact_stiffness(model_, system_, side_.spring_stiffness(frozen, now()),
                                           side_.friction_stiffness(frozen, now()));
  const double allowed = report_.tolerance * surface_scale();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const double left = scheme_.contact_weight() *
                        std::abs(force()[static_cast<Index>(i)] - surface_.applied[static_cast<Index>(i)]);
    const double level =
        stiffness.by_position[dofs[i]] * (reach + far) + stiffness.by_displacement[dofs[i]] * (moved + far);
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
  const double largest = force().size() > 0
                             ? scheme_.contact_weight() * largest_difference(force(), surface_.applied, worst)
                             : 0.0;
  report_.residual = largest == 0 ? 0 : largest / surface_scale();
  if (force().size() > 0)
    report_.worst_node =
        model_.node_of(system_.compliance->dof_of_interface_dof()[static_cast<std::size_t>(worst)]);
}

/// How the points in contact answer, in their linear system.
void Condensed::linearise(const State& trial, const Frozen& frozen) {
  auto& points = scratch_.points;
  points.clear();
  for (const auto& point : scratch_.in_contact) {
    side_.differentiate(trial, frozen, point.zone, point.index, now());
    contact::factor_response(side_.law_of(point.zone, frozen), point.index,
                             now().points[point.zone][point.index], point.status, model_.dofs,
                             points.add(point.zone, point.index, shares_of(point.zone, point.index)));
  }
  add_open_points(frozen);
}

/// Those that share multipliers with others.
void Condensed::add_open_points(const Frozen& frozen) {
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    if (!model_.zones[z].shares_multipliers())
      continue;
    const auto law = side_.law_of(z, frozen);
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

std::optional<Outcome> Condensed::correct(State& trial, const Frozen& frozen, double part) {
  auto correction = corrected(trial, frozen, surface_.moved);
  if (!correction)
    return Outcome::singular_matrix;
  if (follows_free_motions(frozen))
    follow_free_motions(trial, frozen, *correction);
  accelerate(*correction, part);
  if (system_.has_free_bodies)
    part *= reach_.part_of(part * (correction->moved - surface_.moved));
  surface_.consistent = part == 1;
  if (part != 1)
    shorten(*correction, part, trial);
  surface_.applied = std::move(correction->applied);
  surface_.moved = std::move(correction->moved);
  surface_.place(trial);
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    trial.zones[z].multipliers = std::move(correction->multipliers[z]);
  if (!surface_.moved.allFinite())
    return Outcome::singular_matrix;
  return std::nullopt;
}

void Condensed::shorten(Corrected& correction, double part, const State& trial) const {
  const auto keep = [part](const VectorXd& before, VectorXd& after) {
    after = before + part * (after - before);
  };
  keep(surface_.applied, correction.applied);
  keep(surface_.moved, correction.moved);
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    keep(trial.zones[z].multipliers, correction.multipliers[z]);
}

bool Condensed::gaps_are_followed_as_before() const {
  const auto has_weights = [](const ContactIterate& iterate, const PointInContact& point) {
    const auto& kinematics = iterate.points[point.zone][point.index].kinematics;
    return kinematics && kinematics->gap_weights.size() > 0;
  };
  return std::ranges::all_of(scratch_.in_contact, [&](const PointInContact& point) {
    return has_weights(now(), point) == has_weights(previous(), point);
  });
}

/// By iterates with the same statuses, whose gaps are followed alike. Not where corrections are shortened to
/// `part` to leave a cycle: by what is remembered of those the next ones would lead back to it.
void Condensed::accelerate(Corrected& correction, double part) {
  auto& history = scratch_.history;
  if (!scratch_.remembers || report_.iterations < first_remembered)
    return;
  if (part != 1 || report_.status_changes > 0 || !gaps_are_followed_as_before())
    history.forget();
  if (part != 1)
    return;
  history.add(correction.moved - surface_.moved, correction);
  if (!history.is_slow())
    return;
  history.accelerate(correction);
  correction.moved = surface_.moved_by(correction.applied);
}

/// Not where all geometry is held: its linearisation misses nothing.
bool Condensed::follows_free_motions(const Frozen& frozen) const {
  const auto count = scratch_.free_motions.count();
  return count > 0 && report_.residual > report_.tolerance &&
         report_.iterations >= (count <= few_motions ? plain_iterations_of_few : plain_iterations) &&
         std::ranges::any_of(frozen, [](const FrozenZone& zone) { return zone.frames.empty(); });
}

/// Of `shifted` with its surfaces at `moved`, and the statuses that it has.
std::optional<Corrected> Condensed::corrected_at(const VectorXd& moved, const Frozen& frozen,
                                                 State& shifted) {
  surface_.place(moved, shifted);
  side_.measure(shifted, frozen, scratch_.shifted);
  std::swap(scratch_.now, scratch_.shifted);
  collect_forces(frozen);
  auto result = corrected(shifted, frozen, moved);
  std::swap(scratch_.now, scratch_.shifted);
  collect_forces(frozen);
  return result;
}

void Condensed::follow_free_motions(const State& trial, const Frozen& frozen, Corrected& correction) {
  const auto& motions = scratch_.free_motions;
  const double step = std::clamp((correction.moved - surface_.moved).lpNorm<Eigen::Infinity>(),
                                 least_shift * reach_.most(), most_shift * reach_.most());
  State shifted = trial;
  for (std::size_t z = 0; z < shifted.zones.size(); ++z)
    shifted.zones[z].status = now().status[z];
  std::vector<Corrected> others;
  MatrixXd moves(surface_.moved.size(), motions.count());
  for (Index k = 0; k < motions.count(); ++k) {
    const VectorXd moved = surface_.moved + step * motions[k];
    auto result = corrected_at(moved, frozen, shifted);
    if (!result)
      return;
    moves.col(k) = result->moved - moved;
    others.push_back(std::move(*result));
  }
  const auto shares = motions.shares(correction.moved - surface_.moved, moves);
  if (!shares)
    return;
  const Corrected plain = correction;
  for (Index k = 0; k < motions.count(); ++k)
    correction.add((*shares)[k], others[static_cast<std::size_t>(k)], plain);
  correction.moved = surface_.moved_by(correction.applied);
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

bool Condensed::within_rounding(const State& trial, const Frozen& frozen) const {
  const auto stiffness = contact_stiffness(model_, system_, side_.spring_stiffness(frozen, now()),
                                           side_.friction_stiffness(frozen, now()));
  return equilibrium_.within_rounding(trial.motion, stiffness, surface_.free.lpNorm<Eigen::Infinity>(),
                                      report_.tolerance);
}

bool Condensed::in_equilibrium(const State& trial, const Frozen& frozen, const ContactForce& force) {
  equilibrium_.evaluate(trial.motion, force);
  equilibrium_.measure(trial.motion, force, report_);
  scale_ = equilibrium_.scale();
  const double wanted = wanted_residual(system_, report_.tolerance);
  residual_grew_ = residual_grew_ || report_.residual >= last_residual_;
  last_residual_ = report_.residual;
  if (report_.residual <= wanted || (report_.residual <= report_.tolerance && residual_grew_))
    return true;
  if (!bulk_stall_.stalls(report_.residual) || !within_rounding(trial, frozen))
    return false;
  report_.rounding = report_.residual <= report_.tolerance ? 0 : report_.residual;
  return true;
}

} // namespace rubato::step
