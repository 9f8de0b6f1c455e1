// SPDX-License-Identifier: LGPL-3.0-or-later
/// V6 and V7: blocks that slide and stop.
#pragma once

#include "verification/case_runs.hpp"
#include <array>
#include <vector>

namespace rubato::verification {

/// V6: g (sin θ − μ cos θ), and how fast the block gets over the second half of the run.
double incline_acceleration(double friction);
double measured_acceleration(const CaseRun& run);

/// V7: mass m, spring k, weight m g: every half swing the turning point comes nearer by 2 μ m g/k, until the
/// spring is weaker than friction there; ω = √(k/m).
struct SliderTheory {
  std::vector<double> turning_points; ///< the last is where it stays
  double stop = 0;                    ///< instant
};
SliderTheory slider_theory();
/// The extremes of the mark's displacement and the first instant from which it rests there.
SliderTheory measured_slider(const CaseRun& run);

} // namespace rubato::verification
