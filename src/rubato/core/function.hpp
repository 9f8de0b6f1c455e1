// SPDX-License-Identifier: LGPL-3.0-or-later
/// Functions of time.
#pragma once

#include <vector>

namespace rubato {

/// Piecewise-linear function of time. Outside its table it keeps the end values, goes on linearly, or is 0.
struct Function {
  enum class Outside { constant, linear, zero };
  std::vector<double> times; ///< ascending
  std::vector<double> values;
  Outside outside = Outside::constant;
  bool operator==(const Function&) const = default;
};

/// The piecewise-linear function at time `t`; outside its table as `function.outside` says (at both ends of
/// the table it still has its own values). Where a time stands twice, the function jumps and takes the later
/// value there. A table of one point is constant under `linear` too. Throws InputError when
/// the table is empty or times and values differ in number.
double value_at(const Function& function, double t);

} // namespace rubato
