// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is told of a step that could not be made.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/failure.hpp"
#include "rubato/simulation/observer.hpp"

#include <string>

namespace rubato::run {

/// What is kept of an attempt that no cut is left of, with what may help.
results::Failure failure_of(const model::Model& model, const simulation::RejectedStep& step);

/// Where, by which criteria and at which nodes and contact points a step failed, and what may help: a
/// sentence.
std::string explain(const model::Model& model, const results::Failure& failure);

} // namespace rubato::run
