// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/full/whole_system.hpp"

#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/common/move_search.hpp"

#include <algorithm>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;
using model::Model;

/// Iterates of bodies that nothing touches that may come no nearer before they are searched for along their
/// moves: few, since that goes on from the best of them.
constexpr int search_patience = 4;

} // namespace

WholeSystem::WholeSystem(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                         const State& committed, double t, ContactEvaluator& side, Progress&)
    : model_(model), scheme_(scheme), system_(system), side_(side),
      equilibrium_(model, scheme, system, committed, t), path_(ArcLength::of(model, committed, system.step)),
      reach_(reach_of(model, system)),
      on_surfaces_(system.has_free_bodies ? surface_unknowns(model) : std::vector<int>()),
      contact_(committed.motion.u.size(), model.multiplier_count), force_(committed.motion.u.size()) {
  if (model.domain.is_linear())
    return;
  bulk_.emplace(model, scheme, system, committed, t, is_factored() ? Factored::yes : Factored::no);
  searches_ = side_.variant().searches;
  if (is_factored() && side_.variant().hurries)
    bulk_->hurry(search_patience, true);
}

/// Without contact zones the factored matrix is that of the whole system.
bool WholeSystem::is_factored() const {
  return system_.compliance && model_.zones.empty() && !path_ && !side_.variant().indefinite &&
         !side_.variant().exact_tangent;
}

/// Whether anything but the effective matrix stands in the system, or that is not symmetric.
bool WholeSystem::touches() const {
  return model_.multiplier_count > 0 || !contact_.force_by_dof.empty() || scheme_.conserving;
}

std::optional<Outcome> WholeSystem::start(State&, const Frozen&) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  side_.start_iterations();
  forget_moves();
  if (bulk_ && !started_)
    bulk_->start();
  start_ = bulk_ && !started_;
  started_ = true;
  reach_.start();
  return std::nullopt;
}

void WholeSystem::evaluate(const State& trial, const Frozen& frozen, int iteration) {
  evaluate_contact(trial, frozen, iteration);
  if (start_)
    equilibrium_.evaluate_ahead(trial.motion, force_, *bulk_->back_at_start());
  else
    equilibrium_.evaluate(trial.motion, force_);
  equilibrium_.measure(trial.motion, force_, report_);
}

std::optional<Outcome> WholeSystem::close(State& trial, const Frozen& frozen) {
  if (path_ && path_->goes_back(trial.motion.u))
    return Outcome::cycling;
  equilibrium_.finish(force_, trial);
  side_.finish(frozen, now_, trial);
  if (bulk_)
    trial.indefinite = bulk_->is_indefinite() || !is_factored();
  return Outcome::converged;
}

int WholeSystem::points_in_contact() const {
  std::ptrdiff_t count = 0;
  for (const auto& zone : now_.status)
    count += std::ranges::count_if(zone, [](auto status) { return status != contact::Status::open; });
  return static_cast<int>(count);
}

StepReport WholeSystem::ended(Outcome outcome, const Frozen& frozen) {
  report_.outcome = outcome;
  report_.load_factor = equilibrium_.load_factor();
  if (bulk_) {
    bulk_->fill(report_, equilibrium_);
    report_.factorisations += symmetric_.factorisations();
    report_.unstable_directions = symmetric_.negative();
  }
  if (report_.failed()) {
    report_.worst = equilibrium_.worst();
    if (outcome != Outcome::not_finite && outcome != Outcome::cell_failed)
      side_.name_unmet(frozen, report_.iterations > 0 ? &previous_ : nullptr, now_, report_);
    name_residual_growth(report_);
  }
  return report_;
}

void WholeSystem::evaluate_contact(const State& trial, const Frozen& frozen, int iteration) {
  std::swap(previous_, now_);
  side_.evaluate(trial, frozen, now_);
  if (iteration > 0)
    side_.renew_status(frozen, previous_, now_);
  else
    side_.restrict_friction(frozen, now_);
  contact_ = contact::ContactSystem(trial.motion.u.size(), model_.multiplier_count);
  force_ = ContactForce(trial.motion.u.size());
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    add_zone(z, frozen);
  force_.all = contact_.force;
  add_slope_changes(trial.motion);
}

/// To the matrix alone; blocks of contact are weighted when the system is solved.
void WholeSystem::add_slope_changes(const time::Motion& motion) {
  for (const auto& connector : model_.connectors) {
    if (!connector.force && !connector.damper)
      continue;
    const double change = slope_change(connector, system_.coefficients, motion) / scheme_.contact_weight();
    for (const auto& a : connector.row)
      for (const auto& b : connector.row)
        contact_.force_by_dof.emplace_back(a.dof, b.dof, change * a.coefficient * b.coefficient);
  }
}

void WholeSystem::add_zone(std::size_t z, const Frozen& frozen) {
  const VectorXd before = contact_.force;
  contact::add_contributions(side_.law_of(z, frozen), now_.points[z], now_.status[z], model_.dofs,
                             model_.multiplier_offsets[z], contact_);
  force_.for_zone(model_.zones[z], [&](VectorXd& part) { part += contact_.force - before; });
}

bool WholeSystem::is_settled(const State& trial, const Frozen& frozen) {
  if (path_ && !path_->is_met(trial.motion.u))
    return false;
  side_.collect_status_changes(frozen, previous_, now_, report_);
  const bool stalled = stall_.stalls(report_.residual);
  const double negligible = report_.tolerance * equilibrium_.scale();
  if ((report_.status_changes > 0 && side_.has_decisive_changes(frozen, previous_, now_, negligible)) ||
      !side_.settled(frozen, previous_, now_))
    return false;
  const double wanted = wanted_residual(system_, report_.tolerance);
  const bool balanced = report_.residual <= wanted || (stalled && report_.residual <= report_.tolerance);
  if (!balanced && !(stalled && within_rounding(trial, frozen)))
    return false;
  report_.rounding = balanced ? 0 : report_.residual;
  return !side_.release_beyond_borders();
}

bool WholeSystem::within_rounding(const State& trial, const Frozen& frozen) const {
  const auto stiffness = contact_stiffness(model_, system_, side_.spring_stiffness(frozen, now_),
                                           side_.friction_stiffness(frozen, now_));
  return equilibrium_.within_rounding(trial.motion, stiffness, 0, report_.tolerance);
}

std::optional<LinearSolution> WholeSystem::solution(const time::Motion& motion) {
  if (is_factored())
    return LinearSolution{
        system_.compliance->solve(-system_.slopes.adjusted(equilibrium_.residual(), motion)), {}};
  VectorXd load;
  if (path_)
    load = scheme_.forces.now * equilibrium_.controlled_force(motion.u);
  if (const linalg::WholeMatrix matrix(system_.matrix, model_.sharing()); !bulk_ || touches())
    return solve_full({model_, matrix.get(), scheme_.contact_weight(), contact_, equilibrium_.residual(),
                       path_ ? &load : nullptr});
  auto found = symmetric_.solve(model_, system_, -equilibrium_.residual());
  if (!found)
    return std::nullopt;
  LinearSolution solution{std::move(*found), {}};
  if (path_) {
    solution.displacement_by_load = *symmetric_.solve(model_, system_, load);
    solution.multipliers_by_load.resize(0);
  }
  return solution;
}

/// Adds to the solution what the loads do by the change of their factor. False where they move nothing that
/// is measured.
bool WholeSystem::follow_path(const State& trial, LinearSolution& found, double& factor_change) const {
  const auto change = path_->change(trial.motion.u, model_.reduction.scatter(found.displacement),
                                    model_.reduction.scatter(found.displacement_by_load));
  if (!change)
    return false;
  factor_change = *change;
  found.displacement += factor_change * found.displacement_by_load;
  found.multipliers += factor_change * found.multipliers_by_load;
  return true;
}

void WholeSystem::take_load_factor(State& trial, double factor) {
  trial.load_factor = factor;
  equilibrium_.set_load_factor(factor);
  bulk_->set_load_factor(factor);
}

void WholeSystem::keep_best(const State& trial) {
  if (is_factored() && (!best_ || report_.unbalanced_force < best_->unbalanced))
    best_ = {trial.motion, report_.unbalanced_force};
}

/// The iterates have come no nearer for long.
std::optional<Outcome> WholeSystem::search_from_best(State& trial) {
  searches_ = counts_anew_ = true;
  trial.motion = best_->motion;
  bulk_->go_on_from(trial.motion.u, best_->unbalanced);
  equilibrium_.evaluate(trial.motion, force_);
  return std::nullopt;
}

/// An outcome ends the step.
std::optional<Outcome> WholeSystem::go_on_from(State& trial, const Frozen& frozen) {
  if (start_) {
    if (!path_) // the first iterate adds the loads of the step
      bulk_->start_with(report_.unbalanced_force);
    start_ = false;
    return std::nullopt;
  }
  const double allowed = report_.tolerance * equilibrium_.scale();
  keep_best(trial);
  if (const auto outcome = bulk_->go_on(trial.motion.u, report_.unbalanced_force, allowed))
    return bulk_->is_given_up() ? search_from_best(trial) : outcome;
  if (!bulk_->goes_back())
    return std::nullopt;
  trial.motion = before_.motion;
  trial.zones = before_.zones;
  if (path_)
    take_load_factor(trial, before_.load_factor);
  evaluate_contact(trial, frozen, report_.iterations);
  if (const auto* start = bulk_->back_at_start())
    equilibrium_.evaluate_ahead(trial.motion, force_, *start);
  else
    equilibrium_.evaluate(trial.motion, force_);
  return std::nullopt;
}

/// What contact puts on the dofs at `trial`, with the statuses that it calls for there.
ContactForce WholeSystem::force_at(const State& trial, const Frozen& frozen) {
  side_.measure(trial, frozen, searched_);
  side_.renew_status(frozen, now_, searched_);
  ContactForce force(trial.motion.u.size());
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto law = side_.law_of(z, frozen);
    for (std::size_t i = 0; i < searched_.status[z].size(); ++i) {
      const auto status = searched_.status[z][i];
      if (status == contact::Status::open)
        continue;
      const auto& point = searched_.points[z][i];
      const auto of_point = contact::force_of(law, i, point, status);
      force.for_zone(model_.zones[z],
                     [&](VectorXd& part) { point.kinematics->stencil.scatter(of_point, model_.dofs, part); });
    }
  }
  return force;
}

/// Multipliers move along with the bodies.
void WholeSystem::search(State& trial, const Frozen& frozen) {
  const State whole = trial;
  const auto go_to = [&](double part) {
    trial.motion = part == 1 ? whole.motion : between(before_.motion, whole.motion, part);
    for (std::size_t z = 0; z < trial.zones.size(); ++z) {
      const auto& from = before_.zones[z].multipliers;
      trial.zones[z].multipliers = from + part * (whole.zones[z].multipliers - from);
    }
  };
  const auto unbalanced_at = [&](double part) {
    go_to(part);
    const auto force = force_at(trial, frozen);
    equilibrium_.evaluate(trial.motion, force);
    equilibrium_.measure(trial.motion, force, report_);
    return equilibrium_.failed() ? std::nullopt : std::optional(report_.unbalanced_force);
  };
  const auto [best, tried] = search_along_move(bulk_->unbalanced_at_base(), unbalanced_at(1), unbalanced_at);
  if (tried != best)
    go_to(best);
}

/// Moves that go on and on in one direction are those of a matrix that is nearly singular there: of a body
/// that slips along both surfaces that press it, wherever it is between them. By their history they come to
/// an end. What is out of balance says little: it grows on the way along such a direction, and is gone after
/// the next move. So an iterate by history is kept where the move from there is the shorter one.
void WholeSystem::go_on_faster(State& trial) {
  BulkIterate plain{trial.motion, ContactForce(trial.motion.u.size()), {}};
  for (const auto& zone : trial.zones)
    plain.multipliers.push_back(zone.multipliers);
  const auto go_to = [&](const BulkIterate& iterate) {
    trial.motion = iterate.motion;
    for (std::size_t z = 0; z < trial.zones.size(); ++z)
      trial.zones[z].multipliers = iterate.multipliers[z];
  };
  const double moved = (trial.motion.u - before_.motion.u).norm();
  const auto left = std::exchange(left_, std::nullopt);
  if (left && !(moved < left->moved)) {
    history_.forget();
    return go_to(left->iterate);
  }
  history_.add(before_.motion, plain, now_.status);
  if (!history_.is_steadily_slow())
    return;
  const auto faster = history_.accelerated();
  if (!equilibrium_.has_forces_at(faster.motion.u))
    return;
  left_ = {std::move(plain), moved};
  go_to(faster);
}

void WholeSystem::forget_moves() {
  history_.forget();
  left_.reset();
}

/// Frames are measured before a move: they hold for surfaces near there.
double WholeSystem::part_in_reach(const VectorXd& displacement) {
  return on_surfaces_.empty() ? 1 : reach_.part_of(displacement(on_surfaces_));
}

std::optional<Outcome> WholeSystem::correct(State& trial, const Frozen& frozen, double part) {
  if (bulk_)
    if (const auto outcome = go_on_from(trial, frozen))
      return outcome;
  auto found = solution(trial.motion);
  double factor_change = 0;
  if (found && path_ && !follow_path(trial, *found, factor_change))
    return Outcome::singular_matrix;
  if (!found || !found->displacement.allFinite() || !found->multipliers.allFinite())
    return Outcome::singular_matrix;
  part *= part_in_reach(part * found->displacement);
  const VectorXd d = model_.reduction.scatter(part * found->displacement);
  if (bulk_)
    before_ = {trial.motion, trial.zones, trial.load_factor};
  time::correct(system_.coefficients, d, trial.motion);
  if (bulk_) {
    const auto taken = bulk_->shorten(before_.motion, trial.motion, equilibrium_);
    if (!taken)
      return Outcome::cell_failed;
    part *= *taken;
    if (path_)
      take_load_factor(trial, trial.load_factor + part * factor_change);
  }
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    trial.zones[z].multipliers +=
        part * found->multipliers.segment(model_.multiplier_offsets[z], model_.zones[z].multiplier_count());
  if (!bulk_ || path_)
    return std::nullopt;
  if (searches_ && bulk_->is_fresh())
    search(trial, frozen);
  else if (part != 1)
    forget_moves();
  else if (!model_.zones.empty())
    go_on_faster(trial);
  return std::nullopt;
}

} // namespace rubato::step
