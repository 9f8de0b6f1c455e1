// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/linear_table.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rubato {
namespace {

using Outside = LinearTable::Outside;

void check(const LinearTable& table) {
  if (table.at.empty() || table.at.size() != table.values.size())
    throw InputError(
        fmt::format("a table has {} abscissae and {} values, expected as many of both and at least one",
                    table.at.size(), table.values.size()));
}

/// On the line through points i and i + 1; the value of point i when they stand at one place.
double on_piece(const LinearTable& table, std::size_t i, double x) {
  const double begin = table.at[i], length = table.at[i + 1] - begin;
  if (!(length > 0))
    return table.values[i];
  const double part = (x - begin) / length;
  return (1 - part) * table.values[i] + part * table.values[i + 1];
}

double before_table(const LinearTable& table, double x) {
  if (table.outside == Outside::zero)
    return 0;
  if (table.outside == Outside::constant || table.at.size() == 1)
    return table.values.front();
  return on_piece(table, 0, x);
}

double after_table(const LinearTable& table, double x) {
  if (x == table.at.back())
    return table.values.back();
  if (table.outside == Outside::zero)
    return 0;
  if (table.outside == Outside::constant || table.at.size() == 1)
    return table.values.back();
  return on_piece(table, table.at.size() - 2, x);
}

} // namespace

double interpolated(const LinearTable& table, double x) {
  check(table);
  const auto after = std::ranges::upper_bound(table.at, x);
  if (after == table.at.begin())
    return before_table(table, x);
  if (after == table.at.end())
    return after_table(table, x);
  return on_piece(table, static_cast<std::size_t>(after - table.at.begin()) - 1, x);
}

namespace {

/// Of the piece between points i and i + 1, 0 where they stand at one place.
double slope_of(const LinearTable& table, std::size_t i) {
  const double length = table.at[i + 1] - table.at[i];
  return length > 0 ? (table.values[i + 1] - table.values[i]) / length : 0.0;
}

/// From the first abscissa to `x`, which may lie before it.
double integral_from_first(const LinearTable& table, double x) {
  const auto piece = [&](double from, double to) {
    return 0.5 * (interpolated(table, from) + interpolated(table, to)) * (to - from);
  };
  const auto outside = [&](double from) { return table.outside == Outside::zero ? 0.0 : piece(from, x); };
  if (x < table.at.front())
    return outside(table.at.front());
  double sum = 0;
  for (std::size_t i = 0; i + 1 < table.at.size(); ++i) {
    if (x <= table.at[i + 1])
      return sum + 0.5 * (table.values[i] + on_piece(table, i, x)) * (x - table.at[i]);
    sum += 0.5 * (table.values[i] + table.values[i + 1]) * (table.at[i + 1] - table.at[i]);
  }
  return sum + outside(table.at.back());
}

} // namespace

double slope_at(const LinearTable& table, double x) {
  check(table);
  if (table.at.size() == 1)
    return 0;
  const auto after = std::ranges::upper_bound(table.at, x);
  const bool before = after == table.at.begin();
  if ((before || after == table.at.end()) && table.outside != Outside::linear)
    return 0;
  const auto piece = before ? 0 : static_cast<std::size_t>(after - table.at.begin()) - 1;
  return slope_of(table, std::min(piece, table.at.size() - 2));
}

double integral_to(const LinearTable& table, double x) {
  check(table);
  return integral_from_first(table, x) - integral_from_first(table, 0);
}

double steepest(const LinearTable& table) {
  double largest = 0;
  for (std::size_t i = 0; i + 1 < table.at.size(); ++i)
    largest = std::max(largest, std::abs(slope_of(table, i)));
  return largest;
}

} // namespace rubato
