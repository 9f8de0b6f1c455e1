// SPDX-License-Identifier: LGPL-3.0-or-later
/// Parts of run.json.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/checks.hpp"

#include <nlohmann/json_fwd.hpp>

namespace rubato::results {

nlohmann::ordered_json check_json(const CheckResult& result);

/// What decided when steps ended, beside the study's own.
nlohmann::ordered_json tolerances_json();

/// Which side is the slave of zones that leave it to the model, and why.
nlohmann::ordered_json sides_json(const model::Model& model);

} // namespace rubato::results
