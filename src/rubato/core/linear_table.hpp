// SPDX-License-Identifier: LGPL-3.0-or-later
/// Numbers given at some places of a line, in between by straight lines.
#pragma once

#include <vector>

namespace rubato {

/// Outside its table it keeps the end values, goes on linearly, or is 0.
struct LinearTable {
  enum class Outside { constant, linear, zero };
  std::vector<double> at; ///< abscissae, ascending
  std::vector<double> values;
  Outside outside = Outside::constant;
  bool operator==(const LinearTable&) const = default;
};

/// The table at `x`; outside of it as `table.outside` says (at both ends it still has its own values). Where
/// an abscissa stands twice the table jumps and has the later value there. A table of one point is constant
/// under `linear` too. Throws InputError when the table is empty or its lists differ in length.
double interpolated(const LinearTable& table, double x);

/// Of the piece that `x` is on, at a corner of the one after it; outside of the table as it goes on there.
double slope_at(const LinearTable& table, double x);

/// The integral from 0 to `x`.
double integral_to(const LinearTable& table, double x);

/// The largest magnitude of the slopes of all pieces; 0 of a table of one point.
double steepest(const LinearTable& table);

} // namespace rubato
