// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far a run is, in one line of text.
#pragma once

#include "rubato/run/time_loop.hpp"

#include <cstddef>
#include <string>

namespace rubato::run {

/// "42 s", "3:07 min", "1:02:03 h". `seconds` ≥ 0.
std::string duration_text(double seconds);

/// The line for a terminal of `columns` columns. It is shorter than that, as a line that wraps could not be
/// rewritten; the time left stays in it: the bar shortens first, then the step length, the points in contact
/// and the iterations go, and at last the name of the run is cut. `seconds`: time since the first step began.
std::string terminal_line(const Progress& progress, double seconds, std::size_t columns);

/// The same for a file: a percentage instead of the bar, and everything whatever its length.
std::string plain_line(const Progress& progress, double seconds);

} // namespace rubato::run
