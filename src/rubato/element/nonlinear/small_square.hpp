// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inverses of 2 × 2 and 3 × 3 matrices, component (a, b) at a + d b.
#pragma once

#include <array>
#include <cstddef>

namespace rubato::element {

template <int d> using Square = std::array<double, static_cast<std::size_t>(d* d)>;

/// Sets the inverse and returns the determinant.
inline double invert(const Square<2>& m, Square<2>& inverse) {
  const double determinant = m[0] * m[3] - m[1] * m[2];
  const double by = 1 / determinant;
  inverse = {by * m[3], -by * m[1], -by * m[2], by * m[0]};
  return determinant;
}

inline double invert(const Square<3>& m, Square<3>& inverse) {
  const double c0 = m[4] * m[8] - m[5] * m[7], c1 = m[5] * m[6] - m[3] * m[8], c2 = m[3] * m[7] - m[4] * m[6];
  const double determinant = m[0] * c0 + m[1] * c1 + m[2] * c2;
  const double by = 1 / determinant;
  inverse = {by * c0, by * (m[2] * m[7] - m[1] * m[8]), by * (m[1] * m[5] - m[2] * m[4]),
             by * c1, by * (m[0] * m[8] - m[2] * m[6]), by * (m[2] * m[3] - m[0] * m[5]),
             by * c2, by * (m[1] * m[6] - m[0] * m[7]), by * (m[0] * m[4] - m[1] * m[3])};
  return determinant;
}

} // namespace rubato::element
