// SPDX-License-Identifier: LGPL-3.0-or-later
/// Newton's iterations of one implicit step with whatever the outer loops freeze: one loop, whether the whole
/// system is solved for (full/) or the contact points alone (interface/).
#pragma once

#include "rubato/step/common/contact_evaluator.hpp"
#include "rubato/step/common/cycle_detector.hpp"
#include "rubato/step/progress.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

#include <concepts>
#include <limits>
#include <optional>

namespace rubato::step {

/// What the iterations ask of the unknowns that are solved for.
template <class S>
concept NewtonSystem = requires(S system, const S known, State& trial, const Frozen& frozen) {
  /// Before the first iteration; an outcome ends the step.
  { system.start(trial, frozen) } -> std::same_as<std::optional<Outcome>>;
  /// Contact, and what equilibrium needs of it, at the iterate of that number.
  system.evaluate(trial, frozen, 0);
  /// Whether all that has been evaluated is finite.
  { known.is_finite() } -> std::same_as<bool>;
  /// Whether statuses, geometry and the equations solved for fit, after the first iteration.
  { system.is_settled(trial, frozen) } -> std::same_as<bool>;
  /// Of a settled iterate: how the step ends there, nothing when it goes on.
  { system.close(trial, frozen) } -> std::same_as<std::optional<Outcome>>;
  /// Solves and takes part of the correction; an outcome ends the step.
  { system.correct(trial, frozen, 1.0) } -> std::same_as<std::optional<Outcome>>;
  { known.iterate() } -> std::same_as<const ContactIterate&>;
  { known.points_in_contact() } -> std::same_as<int>;
  /// A norm of the contact forces [force].
  { known.force_norm() } -> std::same_as<double>;
  { system.report() } -> std::same_as<StepReport&>;
  /// Of a settled iterate that goes on: whether iterations are counted anew.
  { system.counts_anew() } -> std::same_as<bool>;
  /// The report, with what is not met and where, of a step that fails.
  { system.ended(Outcome::converged, frozen) } -> std::same_as<StepReport>;
};

/// Iterates from `trial` (u, v, a, multipliers and statuses) to the end of the step, with at most
/// `most_iterations` linear solves from where they are counted. Corrections are halved where iterates come
/// back.
template <NewtonSystem S>
StepReport run_newton(S& system, int most_iterations, Progress& progress, State& trial,
                      const Frozen& frozen) {
  if (const auto outcome = system.start(trial, frozen))
    return system.ended(*outcome, frozen);
  CycleDetector cycle;
  StepReport& report = system.report();
  int last = most_iterations;
  for (int iteration = 0; iteration <= last; ++iteration) {
    system.evaluate(trial, frozen, iteration);
    if (!system.is_finite())
      return system.ended(Outcome::not_finite, frozen);
    if (iteration > 0 && system.is_settled(trial, frozen))
      if (const auto outcome = system.close(trial, frozen))
        return system.ended(*outcome, frozen);
    if (system.counts_anew()) {
      last = iteration + most_iterations;
      cycle = {};
    }
    const bool may_cycle = iteration > 0 && report.status_changes > 0;
    const auto part = may_cycle ? cycle.part_of_next(system.iterate(), system.force_norm()) : 1.0;
    if (!part)
      return system.ended(Outcome::cycling, frozen);
    if (iteration == last)
      break;
    const double residual = iteration > 0 ? report.residual : std::numeric_limits<double>::quiet_NaN();
    if (!progress.report(system.points_in_contact(), residual))
      return system.ended(Outcome::interrupted, frozen);
    if (const auto outcome = system.correct(trial, frozen, *part))
      return system.ended(*outcome, frozen);
    ++report.iterations;
  }
  return system.ended(Outcome::too_many_iterations, frozen);
}

} // namespace rubato::step
