// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/quantise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::report {

double Quantised::value(std::size_t i) const {
  if (numbers[i] == not_a_number)
    return std::numeric_limits<double>::quiet_NaN();
  return least + step * numbers[i];
}

Quantised quantise(std::span<const double> values, std::uint16_t levels) {
  double least = std::numeric_limits<double>::infinity();
  double largest = -least;
  for (const double value : values)
    if (std::isfinite(value)) {
      least = std::min(least, value);
      largest = std::max(largest, value);
    }
  Quantised result;
  result.numbers.assign(values.size(), not_a_number);
  if (least > largest)
    return result;
  result.least = least;
  result.step = largest / levels - least / levels; // their difference may be no number
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]))
      result.numbers[i] = result.step > 0 ? static_cast<std::uint16_t>(std::clamp(
                                                std::round((values[i] / result.step) - least / result.step),
                                                0.0, static_cast<double>(levels)))
                                          : std::uint16_t{0};
  return result;
}

} // namespace rubato::report
