// SPDX-License-Identifier: LGPL-3.0-or-later
/// What an integrator hands to its simulation.
#pragma once

#include "rubato/simulation/attempt.hpp"
#include "rubato/simulation/memento.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

namespace rubato::simulation {

/// An attempt that was made, and what it would change.
struct Trial {
  Attempt attempt;
  step::StepReport report;
  step::State state;         ///< reached; means nothing when interrupted
  step::EnergyLedger energy; ///< accepted: of that state
  Counters spent;            ///< counts whatever becomes of it
  bool last = false;         ///< accepted: ends at the last instant
  bool final = false;        ///< rejected: no cut is left
};

} // namespace rubato::simulation
