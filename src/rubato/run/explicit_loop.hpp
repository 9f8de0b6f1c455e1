// SPDX-License-Identifier: LGPL-3.0-or-later
/// The loop of an explicit run: from one instant of results to the next in equal stable steps.
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/run/checkpoints.hpp"
#include "rubato/run/time_loop.hpp"

namespace rubato::run {

/// `setup_start`: processor time when the run began. Throws InputError, before the folder is made, when the
/// deck's step is longer than the stable one.
RunResult run_explicit(const model::Model& model, RunContext& course, const Watch& watch, double setup_start);

} // namespace rubato::run
