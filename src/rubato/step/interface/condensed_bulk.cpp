// SPDX-License-Identifier: LGPL-3.0-or-later
// Iterates of a nonlinear bulk, at each of which contact is solved to its end.
#include "rubato/step/interface/condensed.hpp"

namespace rubato::step {

/// Supports have moved already, the bodies follow by the tangent.
void Condensed::start_ahead(const State& trial) {
  const auto& start = bulk_->start();
  zones_at_base_ = trial.zones;
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
  const auto part = bulk_->shorten(surface_.base, trial.motion, equilibrium_);
  if (!part)
    return Outcome::cell_failed;
  if (*part != 1) {
    equilibrium_.evaluate(trial.motion, force);
    equilibrium_.measure(trial.motion, force, report_);
  }
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
  if (*part != 1 || bulk_->goes_back()) {
    side_.measure(trial, frozen, now());
    collect_forces(frozen);
  }
  zones_at_base_ = trial.zones;
  scratch_.history.forget();
  surface_stall_ = bulk_stall_ = {};
  counts_anew_ = true;
  return std::nullopt;
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
