// SPDX-License-Identifier: LGPL-3.0-or-later
/// Runs that name other runs of the deck: to start from their end, or to be compared with them.
#pragma once

#include "rubato/deck/faults.hpp"
#include "rubato/deck/places.hpp"
#include "rubato/study/study.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::deck {

/// Faults where the study names a run that no earlier one has, or that does not fit. `all` are the names of
/// every run of the deck, in its order; `earlier` those of them before the study that were read: comparisons
/// with others are left to the results. Whether the study fits what it starts from.
bool check_other_runs(const study::Study& study, std::span<const study::Study> earlier,
                      const std::vector<std::string>& all, const Places& places, Faults& faults);

} // namespace rubato::deck
