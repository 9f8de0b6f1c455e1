// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/range.hpp"

#include <fmt/format.h>

#include <cmath>

namespace rubato::study {

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_allowed ? value >= low : value > low) &&
         (high_allowed ? value <= high : value < high);
}

std::string bounds_text(const Range& range) {
  const bool low = std::isfinite(range.low);
  const bool high = std::isfinite(range.high);
  if (low && high && range.low_allowed == range.high_allowed)
    return range.low_allowed ? fmt::format(" from {:.6g} to {:.6g}", range.low, range.high)
                             : fmt::format(" between {:.6g} and {:.6g}", range.low, range.high);
  const auto above = low ? fmt::format(" {} {:.6g}", range.low_allowed ? ">=" : ">", range.low) : "";
  const auto below = high ? fmt::format(" {} {:.6g}", range.high_allowed ? "<=" : "<", range.high) : "";
  return above + (low && high ? " and" : "") + below;
}

} // namespace rubato::study
