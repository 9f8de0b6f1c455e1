// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/history.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::results {
namespace {

/// Instants nearer than this part of the history's length are the same.
constexpr double same_instant = 1e-9;

} // namespace

bool is_same_instant(double a, double b, double length) {
  return std::abs(a - b) <= same_instant * length;
}

bool is_named_instant(std::span<const double> instants, double t, double step) {
  constexpr double part_of_step = 1e-6;
  return std::ranges::any_of(instants, [&](double at) {
    return std::abs(t - at) <= std::max(step * part_of_step, same_instant * std::abs(at));
  });
}

std::optional<double> value_at(const Table& history, int column, double t) {
  if (column < 0 || history.rows.empty())
    return std::nullopt;
  const auto c = static_cast<std::size_t>(column);
  const double length = history.rows.back()[0] - history.rows.front()[0];
  const auto after = std::ranges::find_if(
      history.rows, [&](const auto& row) { return row[0] >= t || is_same_instant(row[0], t, length); });
  if (after == history.rows.end())
    return std::nullopt;
  if (is_same_instant((*after)[0], t, length))
    return (*after)[c];
  if (after == history.rows.begin())
    return std::nullopt;
  const auto& before = *(after - 1);
  const double part = (t - before[0]) / ((*after)[0] - before[0]);
  return before[c] + part * ((*after)[c] - before[c]);
}

} // namespace rubato::results
