// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "rubato/deck/read.hpp"

#include <filesystem>

namespace rubato::app {

/// Builds the model of each run and prints what it would be and where; writes nothing. Returns the exit code.
/// Throws InputError for what a run would be refused for before its first step.
int show_plans(const deck::Deck& deck, const std::filesystem::path& output, bool resume);

} // namespace rubato::app
