// SPDX-License-Identifier: LGPL-3.0-or-later
/// One implicit step, with what is tried before it is given up.
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/step/effective_system.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

namespace rubato::step {

/// Advances `committed` to t. On success `trial` is the state at t. A failed attempt is repeated with other
/// augmentations, then with friction raised in parts, before it is reported.
StepReport advance(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                   const State& committed, double t, State& trial);

} // namespace rubato::step
