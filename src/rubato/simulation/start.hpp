// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where a simulation begins.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/simulation/memento.hpp"
#include "rubato/step/state.hpp"

#include <cstddef>
#include <functional>

namespace rubato::simulation {

/// At the study's beginning, if nothing else is said. Nothing of it is kept but the function.
struct Start {
  /// The end of the run that the study starts from (time.start.from); ignored of other studies.
  const step::State* previous = nullptr;
  /// To go on from, in the place of any beginning.
  const Memento* memento = nullptr;
  /// Hears what each factor of an effective matrix needs [bytes] before it is computed, the first one while
  /// the simulation is built.
  std::function<void(std::size_t)> tell_memory = [](std::size_t) {};
  /// Of a model that is built from a study; others have theirs.
  Workers workers = {};
};

} // namespace rubato::simulation
