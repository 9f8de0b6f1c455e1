// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/linear_table.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

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

} // namespace rubato
