// SPDX-License-Identifier: LGPL-3.0-or-later
/// What may help where a step could not be made.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/failure.hpp"
#include "rubato/time/scheme.hpp"

#include <string>
#include <vector>

namespace rubato::run {

/// Whether contact gives energy to a scheme that keeps it: exact gaps, and nothing that damps what rings.
bool feeds_on_contact(const model::Model& model, const time::Scheme& scheme);

/// What may help against the criteria that the last attempt did not meet, the likeliest first, in words of
/// the deck. Whatever the deck would refuse is left out, and so is what has been tried already.
std::vector<std::string> advice(const model::Model& model, const time::Scheme& scheme,
                                const results::Failure& failure);

} // namespace rubato::run
