// SPDX-License-Identifier: LGPL-3.0-or-later
/// Adds multiples of columns to a sum, several in one pass over it.
#pragma once

#include <array>
#include <cstddef>

namespace rubato::linalg {

class ColumnSum {
public:
  ColumnSum(double* sum, std::ptrdiff_t size) : sum_(sum), size_(size) {}

  void add(double factor, const double* column) {
    factors_[count_] = factor;
    columns_[count_] = column;
    if (++count_ < at_once)
      return;
    count_ = 0;
    const auto [a, b, c, d] = factors_;
    const double* const p = columns_[0];
    const double* const q = columns_[1];
    const double* const r = columns_[2];
    const double* const s = columns_[3];
    for (std::ptrdiff_t i = 0; i < size_; ++i)
      sum_[i] += (a * p[i] + b * q[i]) + (c * r[i] + d * s[i]);
  }

  /// What add has not come to yet: to be called in the end.
  void add_rest() {
    for (std::size_t k = 0; k < count_; ++k)
      for (std::ptrdiff_t i = 0; i < size_; ++i)
        sum_[i] += factors_[k] * columns_[k][i];
    count_ = 0;
  }

private:
  static constexpr std::size_t at_once = 4;
  double* sum_;
  std::ptrdiff_t size_;
  std::size_t count_ = 0;
  std::array<double, at_once> factors_{};
  std::array<const double*, at_once> columns_{};
};

} // namespace rubato::linalg
