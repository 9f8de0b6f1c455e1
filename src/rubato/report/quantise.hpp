// SPDX-License-Identifier: LGPL-3.0-or-later
/// Numbers as whole numbers of 16 bits between the least and the largest of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::report {

struct Quantised {
  double least = 0.0; ///< of the finite values; 0 where there are none
  double step = 0.0;  ///< between neighbouring numbers; 0 where all values are equal
  std::vector<std::uint16_t> numbers;

  /// Off by half a step at most. What was not finite is NaN.
  double value(std::size_t i) const;
};

/// Stands for a value that is not finite.
inline constexpr std::uint16_t not_a_number = 0xFFFF;
/// The largest value. Below it are `levels` steps.
inline constexpr std::uint16_t finest_levels = 0xFFFE;

/// `levels`: 1 to finest_levels. Fewer take less room when they are compressed.
Quantised quantise(std::span<const double> values, std::uint16_t levels = finest_levels);

} // namespace rubato::report
