// SPDX-License-Identifier: LGPL-3.0-or-later
/// The runs of a deck, several at once, each in a process of its own.
#pragma once

#include "rubato/deck/read.hpp"

#include "run_one.hpp"

namespace rubato::app {

/// Runs all of them, at most `jobs` at once. A run waits for the end of those that it starts from or is
/// compared with, and for memory. The value is the largest exit code. This program must have one thread.
int run_side_by_side(const deck::Deck& deck, const RunSettings& settings, int jobs);

} // namespace rubato::app
