// SPDX-License-Identifier: LGPL-3.0-or-later
/// Attempts at steps: when, how they ended and why.
#pragma once

#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/progress.hpp"
#include "rubato/step/report.hpp"

#include <functional>

namespace rubato::simulation {

/// One attempt at a step.
struct Attempt {
  double begin = 0;
  double end = 0;
  int cut_level = 0;
  bool accepted = false;
  double seconds = 0; ///< processor time
  /// Steps of time made in it: 1, or 0 where that one was not; of explicit simulations all up to the record.
  int steps = 0;
};

enum class Verdict {
  accepted,      ///< the simulation stands at the end of the attempt
  cut,           ///< not solved; the simulation stands where it was, and the next attempt is a shorter one
  not_converged, ///< not solved, and no cut is left; the simulation stands where it was
  interrupted    ///< asked to end; its state is what it was
};

/// How an attempt ended.
struct StepResult {
  Verdict verdict = Verdict::interrupted;
  Attempt attempt;
  step::StepReport report;
  step::EnergyLedger energy; ///< of the state that the simulation has now

  bool accepted() const { return verdict == Verdict::accepted; }
};

/// Where an attempt stands that is being made.
struct Moment {
  const Attempt& attempt;
  step::ProgressState progress;
};

/// Is told of moments; whether the attempt is to go on.
using GoesOn = std::function<bool(const Moment&)>;

} // namespace rubato::simulation
