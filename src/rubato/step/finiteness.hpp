// SPDX-License-Identifier: LGPL-3.0-or-later
/// The first thing in a step that is not finite: where it comes from, not where it was met.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

#include <string>

namespace rubato::step {

/// "the load on node N5 (1, 0.1)": of loads, imposed displacements, the motion and the contact multipliers of
/// `trial`, and the residual, in this order, the first with a value that is not finite. Empty when none has.
/// `t`: the end of the step.
std::string first_not_finite(const model::Model& model, double t, const State& trial,
                             const StepReport& report);

} // namespace rubato::step
