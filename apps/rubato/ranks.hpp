// SPDX-License-Identifier: LGPL-3.0-or-later
/// The program as one of several processes that `mpiexec` started for one run.
#pragma once

#include "rubato/core/ranks.hpp"

#include <functional>

namespace rubato::app {

/// The first rank speaks for all: what others print goes nowhere from here on, but for what `together` says.
void hush_other_ranks();

/// Does this rank's part and gives its exit code; exceptions pass. All ranks end together: where this one is
/// the only one to end, it says why and ends the others, too.
int together(const Ranks& ranks, const std::function<int()>& part);

} // namespace rubato::app
