// SPDX-License-Identifier: LGPL-3.0-or-later
/// Values of a history (a table whose first column is the time) at an instant.
#pragma once

#include "rubato/results/csv.hpp"

#include <optional>
#include <span>

namespace rubato::results {

/// Whether two instants of a history are one but for rounding. `length`: from its first to its last instant.
bool is_same_instant(double a, double b, double length);

/// Whether the end t of a step of that length is one of the instants that a deck names.
bool is_named_instant(std::span<const double> instants, double t, double step);

/// The value of a column at instant t, between two rows linearly; nothing when the history doesn't reach it
/// or there is no such column (−1).
std::optional<double> value_at(const Table& history, int column, double t);

} // namespace rubato::results
