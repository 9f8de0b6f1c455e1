// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace rubato::plot {
namespace {

/// Ranges shorter than this part of their numbers show rounding only.
constexpr double shortest_range = 1e-12;
/// Labels have an exponent of their own from so many digits on, before or behind the point.
constexpr int most_digits = 4;

/// step = multiple · 10^power
struct Step {
  int multiple = 1;
  int power = 0;
  /// Dividing by a power of ten gives the nearest number to 3 · 0.1; multiplying does not.
  double times(double count) const {
    const double number = count * multiple;
    return power < 0 ? number / std::pow(10.0, -power) : number * std::pow(10.0, power);
  }
};

Step step_for(double length, int most) {
  const double least = length / most;
  Step step{1, static_cast<int>(std::floor(std::log10(least)))};
  for (const int multiple : {1, 2, 5, 10}) {
    step.multiple = multiple;
    if (step.times(1) >= least)
      break;
  }
  if (step.multiple == 10)
    return {1, step.power + 1};
  return step;
}

int exponent_for(double largest) {
  const int magnitude = static_cast<int>(std::floor(std::log10(largest)));
  if (magnitude > -most_digits + 1 && magnitude < most_digits)
    return 0;
  constexpr int thousand = 3; // as in kilo and milli
  return static_cast<int>(std::floor(static_cast<double>(magnitude) / thousand)) * thousand;
}

} // namespace

Range range_of(const std::vector<double>& values, double margin) {
  Range range{INFINITY, -INFINITY};
  for (const double value : values)
    if (std::isfinite(value))
      range = {std::min(range.low, value), std::max(range.high, value)};
  if (range.low > range.high)
    return {0, 1};
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  if (range.length() <= shortest_range * largest) {
    const double half = largest > 0 ? largest / 2 : 1;
    return {range.low - half, range.high + half};
  }
  const double more = margin * range.length();
  return {range.low - more, range.high + more};
}

Ticks ticks_in(Range range, int most) {
  Ticks ticks;
  const auto step = step_for(range.length(), std::max(most, 2));
  constexpr double slack = 1e-9; // of a step: an end that is a tick but for rounding
  const double first = std::ceil(range.low / step.times(1) - slack);
  const double last = std::floor(range.high / step.times(1) + slack);
  for (int i = 0; first + i <= last; ++i)
    ticks.values.push_back(first + i == 0 ? 0.0 : step.times(first + i)); // not −0
  ticks.exponent = exponent_for(std::max({std::abs(range.low), std::abs(range.high), step.times(1)}));
  ticks.decimals = std::max(0, ticks.exponent - step.power);
  return ticks;
}

std::string label_of(const Ticks& ticks, double value) {
  auto label = fmt::format("{:.{}f}", value / std::pow(10.0, ticks.exponent), ticks.decimals);
  return label.starts_with('-') ? "−" + label.substr(1) : label;
}

std::string factor_of(const Ticks& ticks) {
  if (ticks.exponent == 0)
    return "";
  constexpr std::array<std::string_view, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = ticks.exponent < 0 ? "×10⁻" : "×10";
  for (const char digit : std::to_string(std::abs(ticks.exponent)))
    text += raised[static_cast<std::size_t>(digit - '0')];
  return text;
}

} // namespace rubato::plot
