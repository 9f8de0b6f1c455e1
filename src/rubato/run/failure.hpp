// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is told of a step that could not be made.
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/results/recorder.hpp"
#include "rubato/step/report.hpp"
#include "rubato/time/scheme.hpp"

#include <string>
#include <vector>

namespace rubato::run {

/// Whether contact gives energy to a scheme that keeps it: exact gaps, and nothing that damps what rings.
bool feeds_on_contact(const model::Model& model, const time::Scheme& scheme);

/// What may help, the likeliest first, in words of the deck.
std::vector<std::string> advice(const model::Model& model, const time::Scheme& scheme,
                                const step::StepReport& report);

/// Where, at which level and at which nodes and contact points a step failed, and what may help: a sentence.
std::string explain(const model::Model& model, const results::Failure& failure);

} // namespace rubato::run
