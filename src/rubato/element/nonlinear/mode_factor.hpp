// SPDX-License-Identifier: LGPL-3.0-or-later
/// LU factors, with exchange of rows, of the stiffness of a cell's own unknowns, and Newton's steps for them.
/// Its size is known at run time: HEXA8 and QUAD4 share one compilation. No memory is allocated.
#pragma once

#include "rubato/element/nonlinear.hpp"
#include "rubato/element/nonlinear/block_sums.hpp"

#include <array>
#include <cstddef>

namespace rubato::element {

constexpr int most_modes_of_cell = 12;

/// Numbers of the cell's own unknowns.
using ModeValues = std::array<double, static_cast<std::size_t>(most_modes_of_cell)>;

class ModeFactor {
public:
  /// Of the square at (first, first) of a matrix.
  ModeFactor(const MatrixView& matrix, int first, int size);

  /// `values` becomes the solution.
  void solve(ModeValues& values) const;

private:
  int size_;
  std::array<ModeValues, static_cast<std::size_t>(most_modes_of_cell)> columns_; ///< 1/pivots on the diagonal
  std::array<std::size_t, static_cast<std::size_t>(most_modes_of_cell)> exchanged_;
};

/// Σ x_i y_i.
double dot(const ModeValues& x, const ModeValues& y, int size);
/// max |x_i|; NaN if one of them is.
double largest(const ModeValues& values, int size);

/// A step of Newton's method for the modes, halved while a law fails or it leads to nothing better. False: it
/// has stalled.
template <class Respond, class IsBetter>
bool go_halving(const ModeValues& step, int size, ModeValues& unknowns, CellResult& result,
                const Respond& respond, const IsBetter& is_better) {
  constexpr int most_halvings = 6;
  const ModeValues start = unknowns;
  double part = 1;
  for (int i = 0; i <= most_halvings; ++i, part /= 2) {
    for (std::size_t m = 0; m < static_cast<std::size_t>(size); ++m)
      unknowns[m] = start[m] + part * step[m];
    result = respond();
    if (result && is_better())
      return true;
  }
  return false;
}

} // namespace rubato::element
