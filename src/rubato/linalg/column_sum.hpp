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
    if (++count_ == at_once)
      add_columns<at_once>();
  }

  /// What add has not come to yet: to be called in the end.
  void add_rest() {
    if (count_ == 3)
      add_columns<3>();
    else if (count_ == 2)
      add_columns<2>();
    else if (count_ == 1)
      add_columns<1>();
  }

private:
  static constexpr std::size_t at_once = 4;

  template <std::size_t Count> void add_columns() {
    // Without the promise that nothing overlaps every call would check it.
    double* const __restrict sum = sum_;
    const auto factors = factors_;
    const auto columns = columns_;
    for (std::ptrdiff_t i = 0; i < size_; ++i) {
      double part = factors[0] * columns[0][i];
      for (std::size_t k = 1; k < Count; ++k)
        part += factors[k] * columns[k][i];
      sum[i] += part;
    }
    count_ = 0;
  }

  double* sum_;
  std::ptrdiff_t size_;
  std::size_t count_ = 0;
  std::array<double, at_once> factors_{};
  std::array<const double*, at_once> columns_{};
};

} // namespace rubato::linalg
