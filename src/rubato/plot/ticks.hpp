// SPDX-License-Identifier: LGPL-3.0-or-later
/// Round numbers along an axis.
#pragma once

#include <string>
#include <vector>

namespace rubato::plot {

/// From `low` to `high`, low < high.
struct Range {
  double low = 0;
  double high = 1;
  double length() const { return high - low; }
};

/// The range of the numbers that are finite, widened at both ends by that part of its length. Of one number
/// only, or of none, a range around it.
Range range_of(const std::vector<double>& values, double margin = 0);

/// Multiples of 1, 2 or 5 times a power of ten inside of a range.
struct Ticks {
  std::vector<double> values; ///< ascending
  int exponent = 0;           ///< labels are values over 10^exponent
  int decimals = 0;           ///< of labels
};

/// At most `most` of them, 2 or more.
Ticks ticks_in(Range range, int most);

/// A tick as its label shows it, with the sign −.
std::string label_of(const Ticks& ticks, double value);

/// "×10⁻³", or nothing when the exponent is 0.
std::string factor_of(const Ticks& ticks);

} // namespace rubato::plot
