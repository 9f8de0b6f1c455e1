// SPDX-License-Identifier: LGPL-3.0-or-later
/// One implicit step, with what is tried before it is given up.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/progress.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <string>

namespace rubato::step {

/// How steps with this system are solved, and why: for the log.
std::string solver_of(const model::Model& model, const EffectiveSystem& system);

/// What the scheme predicts for t, with the displacements imposed there.
State predict(const model::Model& model, const time::Scheme& scheme, const EffectiveSystem& system,
              const State& committed, double t);
/// The same into another object, in whose storage it fits.
void predict(const model::Model& model, const time::Scheme& scheme, const EffectiveSystem& system,
             const State& committed, double t, State& trial);

/// Advances `committed` to t. `goes_on` is asked at least once an iteration (step/progress.hpp); when it says
/// no, the step ends as interrupted and `trial` means nothing. On success `trial` is the state at t; of what
/// it was before nothing but its storage is used. A failed attempt is repeated with other augmentations, then
/// with other loops, then with friction raised in parts, before it is reported.
StepReport advance(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                   const State& committed, double t, State& trial, const GoesOn& goes_on = {});

/// Makes a converged step one that failed where plastic strain has grown by more than the study allows.
void refuse_large_plastic_step(const model::Model& model, const State& committed, const State& trial,
                               StepReport& report);

} // namespace rubato::step
