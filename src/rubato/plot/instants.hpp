// SPDX-License-Identifier: LGPL-3.0-or-later
/// Instants that a run has stored.
#pragma once

#include <filesystem>
#include <span>

namespace rubato::plot {

/// The stored instant that is `at` but for rounding. `stored`: ascending, at least one. Throws InputError
/// with the nearest stored ones when there is none.
double stored_instant(const std::filesystem::path& run, std::span<const double> stored, double at);

} // namespace rubato::plot
