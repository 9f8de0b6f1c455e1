// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/instants.hpp"

#include "rubato/core/error.hpp"
#include "rubato/results/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rubato::plot {

double stored_instant(const std::filesystem::path& run, std::span<const double> stored, double at) {
  const double length = std::max(stored.back() - stored.front(), std::abs(stored.back()));
  const auto found =
      std::ranges::find_if(stored, [&](double t) { return results::is_same_instant(t, at, length); });
  if (found != stored.end())
    return *found;
  const auto after = std::ranges::upper_bound(stored, at);
  if (after == stored.begin() || after == stored.end())
    throw InputError(fmt::format("{}: nothing is stored at t = {}; the nearest stored is {:.12g}",
                                 run.string(), at, after == stored.begin() ? stored.front() : stored.back()));
  throw InputError(fmt::format("{}: nothing is stored at t = {}; the nearest stored are {:.12g} and {:.12g}",
                               run.string(), at, *(after - 1), *after));
}

} // namespace rubato::plot
