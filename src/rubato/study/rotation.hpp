// SPDX-License-Identifier: LGPL-3.0-or-later
/// Parts that rotate as rigid ones.
#pragma once

#include "rubato/study/values.hpp"

#include <array>

namespace rubato::study {

/// A rigid rotation about a line that stays where it is, by an angle of any size that changes with time.
struct Rotation {
  std::array<double, 3> about{};       ///< a place on the line [length]
  std::array<double, 3> axis{0, 0, 1}; ///< along the line, of any length > 0; in the plane z
  Field angle;                         ///< [radians], by the right-hand rule: a number or an expression of t
  bool operator==(const Rotation&) const = default;
};

} // namespace rubato::study
