// SPDX-License-Identifier: LGPL-3.0-or-later
/// All that steps change, as a plain value: a simulation that is given it goes on to the same bits.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/explicit/explicit_memory.hpp"
#include "rubato/step/overlap.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/step_control.hpp"

#include <optional>
#include <variant>

namespace rubato::simulation {

/// What a simulation has spent since its beginning.
struct Counters {
  int steps = 0;      ///< accepted; explicit: made
  int iterations = 0; ///< linear solves, those of rejected attempts included
  int cuts = 0;

  bool operator==(const Counters&) const = default;
};

struct ImplicitProgress {
  time::StepControl::Place place;
  step::EnergyLedger energy;
  step::Overlaps overlaps; ///< of the energy account
};

struct ExplicitProgress {
  /// At the instant of the state, or, after an interruption, further on the way to the next record.
  step::ExplicitMemory motion;
  double limit = 0; ///< of the step, which never grows [time]
  /// At the instant of the state; where it is not known, that of the motion is taken.
  std::optional<step::EnergyLedger> energy = {};
};

struct Memento {
  step::State state; ///< of the last step that counts
  Counters counters;
  std::variant<ImplicitProgress, ExplicitProgress> progress;
};

/// Whether a state has the unknowns and contact points of a model.
bool fits(const model::Model& model, const step::State& state);
/// Whether its materials remember as many numbers as those of the model.
bool remembers_alike(const model::Model& model, const step::State& state);

/// Throws InputError for a memento of another model, or of another way to step.
void check_fits(const model::Model& model, const Memento& memento);

} // namespace rubato::simulation
