// SPDX-License-Identifier: LGPL-3.0-or-later
/// Who is told of steps before a simulation commits them.
#pragma once

#include "rubato/simulation/attempt.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/state.hpp"

#include <functional>

namespace rubato::simulation {

/// A step that is about to count.
struct AcceptedStep {
  const step::State& before;
  const step::State& now;
  const Attempt& attempt;
  const step::StepReport& report;
  const step::EnergyLedger& energy; ///< with this step
  bool last = false;                ///< whether it ends at the last instant
};

/// An attempt that does not count.
struct RejectedStep {
  const step::State& reached; ///< where it ended: no solution
  const Attempt& attempt;
  const step::StepReport& report;
  bool final = false; ///< whether no cut is left
};

/// What is told, and when: while the simulation still stands where the attempt began. When a function throws,
/// all observers that were told of this attempt, that one included, take back what they have made of it, the
/// last one first. The simulation stays as it was, and the exception goes on. Observers may read
/// the simulation; they must not change it.
struct Observer {
  std::function<void(const AcceptedStep&)> accepted = [](const AcceptedStep&) {};
  std::function<void(const RejectedStep&)> rejected = [](const RejectedStep&) {};
  /// Must not throw. The state is the one that stays.
  std::function<void(const step::State&)> take_back = [](const step::State&) {};
};

} // namespace rubato::simulation
