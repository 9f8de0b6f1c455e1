// SPDX-License-Identifier: LGPL-3.0-or-later
// Iterates of a nonlinear bulk, at each of which contact is solved to its end.
#include "rubato/step/common/move_search.hpp"
#include "rubato/step/interface/condensed.hpp"

namespace rubato::step {

/// Supports have moved already, the bodies follow by the tangent.
void Condensed::start_ahead(const State& trial) {
  const auto& start = bulk_->start();
  zones_at_base_ = trial.zones;
  force_at_base_.all = committed_.contact_force;
  if (bulk_->starts_indefinite())
    return;
  if (bulk_->renewed())
    take_factor();
  equilibrium_.evaluate_ahead(trial.motion, ContactForce(trial.motion.u.size()), start);
  bulk_->start_with(equilibrium_.unbalanced_with(committed_.contact_force));
  surface_.start_from(trial.motion, equilibrium_.residual());
}

/// Contact starts anew from the next iterate of the bulk, with the forces that it has.
std::optional<Outcome> Condensed::go_on_from(State& trial, const Frozen& frozen, ContactForce force) {
  auto part = bulk_->shorten(surface_.base, trial.motion, equilibrium_);
  if (!part)
    return Outcome::cell_failed;
  if (*part != 1) {
    equilibrium_.evaluate(trial.motion, force);
    equilibrium_.measure(trial.motion, force, report_);
  }
  if (side_.variant().searches && bulk_->is_fresh())
    *part *= search(trial, force);
  const bool faster = *part == 1 && go_on_faster(trial, force);
  if (!equilibrium_.residual().allFinite())
    return Outcome::not_finite;
  const double allowed = report_.tolerance * equilibrium_.scale();
  if (const auto outcome = bulk_->go_on(trial.motion.u, report_.unbalanced_force, allowed))
    return outcome;
  if (bulk_->renewed())
    take_factor();
  if (bulk_->goes_back())
    go_back(trial);
  else if (bases_carry_forces())
    surface_.start_from(trial.motion, equilibrium_.residual(), Condensed::force());
  else
    surface_.start_from(trial.motion, equilibrium_.residual_without(force));
  if (!surface_.free.allFinite())
    return Outcome::not_finite;
  if (*part != 1 || faster || bulk_->goes_back()) {
    side_.measure(trial, frozen, now());
    collect_forces(frozen);
  }
  zones_at_base_ = trial.zones;
  if (!bulk_->goes_back())
    force_at_base_ = std::move(force);
  scratch_.history.forget();
  surface_stall_ = {};
  counts_anew_ = true;
  return std::nullopt;
}

/// Contact forces are taken to change along with the motion. How much of the move is left.
double Condensed::search(State& trial, ContactForce& force) {
  const auto whole = trial.motion;
  const auto whole_force = force;
  const auto unbalanced = [&] {
    return equilibrium_.failed() ? std::nullopt : std::optional(report_.unbalanced_force);
  };
  const auto unbalanced_at = [&](double part) {
    trial.motion = part == 1 ? whole : between(surface_.base, whole, part);
    force = whole_force.after(force_at_base_, part);
    equilibrium_.evaluate(trial.motion, force);
    equilibrium_.measure(trial.motion, force, report_);
    return unbalanced();
  };
  const auto [best, tried] = search_along_move(bulk_->unbalanced_at_base(), unbalanced(), unbalanced_at);
  if (tried != best)
    unbalanced_at(best);
  return best;
}

/// Where springs in the matrix hold moves back: by the history of moves, if that leaves less out of balance.
bool Condensed::go_on_faster(State& trial, ContactForce& force) {
  if (system_.held.empty() && !system_.has_free_bodies)
    return false;
  BulkIterate plain{trial.motion, force, {}};
  for (const auto& zone : trial.zones)
    plain.multipliers.push_back(zone.multipliers);
  bulk_history_.add(surface_.base, plain, now().status);
  if (!bulk_history_.is_slow())
    return false;
  const auto go_to = [&](const BulkIterate& iterate) {
    trial.motion = iterate.motion;
    force = iterate.force;
    for (std::size_t z = 0; z < trial.zones.size(); ++z)
      trial.zones[z].multipliers = iterate.multipliers[z];
    equilibrium_.evaluate(trial.motion, force);
    equilibrium_.measure(trial.motion, force, report_);
  };
  const double before = report_.unbalanced_force;
  go_to(bulk_history_.accelerated());
  if (!equilibrium_.failed() && report_.unbalanced_force < before)
    return true;
  go_to(plain);
  return false;
}

void Condensed::go_back(State& trial) {
  trial.motion = surface_.base;
  trial.zones = zones_at_base_;
  const ContactForce none(trial.motion.u.size());
  if (const auto* start = bulk_->back_at_start())
    equilibrium_.evaluate_ahead(trial.motion, none, *start);
  else
    equilibrium_.evaluate(trial.motion, none);
  surface_.start_from(trial.motion, equilibrium_.residual());
}

void Condensed::take_factor() {
  scratch_.forget();
}

} // namespace rubato::step
