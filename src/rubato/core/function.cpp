// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/function.hpp"

#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato {
namespace {

using Outside = Function::Outside;

void check(const Function& function) {
  if (function.times.empty() || function.times.size() != function.values.size())
    throw InputError(
        fmt::format("a function of time has {} times and {} values, expected as many of both and at "
                    "least one",
                    function.times.size(), function.values.size()));
}

/// On the line through points i and i + 1; the value of point i when they stand at one time.
double on_piece(const Function& function, std::size_t i, double t) {
  const double begin = function.times[i], length = function.times[i + 1] - begin;
  if (!(length > 0))
    return function.values[i];
  const double part = (t - begin) / length;
  return (1 - part) * function.values[i] + part * function.values[i + 1];
}

double before_table(const Function& function, double t) {
  if (function.outside == Outside::zero)
    return 0;
  if (function.outside == Outside::constant || function.times.size() == 1)
    return function.values.front();
  return on_piece(function, 0, t);
}

double after_table(const Function& function, double t) {
  if (t == function.times.back())
    return function.values.back();
  if (function.outside == Outside::zero)
    return 0;
  if (function.outside == Outside::constant || function.times.size() == 1)
    return function.values.back();
  return on_piece(function, function.times.size() - 2, t);
}

} // namespace

double value_at(const Function& function, double t) {
  check(function);
  const auto after = std::ranges::upper_bound(function.times, t);
  if (after == function.times.begin())
    return before_table(function, t);
  if (after == function.times.end())
    return after_table(function, t);
  return on_piece(function, static_cast<std::size_t>(after - function.times.begin()) - 1, t);
}

} // namespace rubato
