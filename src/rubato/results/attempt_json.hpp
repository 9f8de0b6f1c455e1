// SPDX-License-Identifier: LGPL-3.0-or-later
/// Attempts at steps as JSON.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/failure.hpp"
#include "rubato/simulation/attempt.hpp"

#include <nlohmann/json_fwd.hpp>

namespace rubato::results {

/// The object of an attempt in steps.jsonl.
nlohmann::ordered_json to_json(const model::Model& model, const simulation::Attempt& attempt,
                               const step::StepReport& report);

/// The object `failure` of run.json.
nlohmann::ordered_json to_json(const model::Model& model, const Failure& failure);

} // namespace rubato::results
