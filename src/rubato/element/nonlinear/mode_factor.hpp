// SPDX-License-Identifier: LGPL-3.0-or-later
/// LU factors, with exchange of rows, of the stiffness of a cell's own unknowns, and Newton's steps for them.
/// Its size is known at run time: HEXA8 and QUAD4 share one compilation. No memory is allocated.
#pragma once

#include "rubato/element/nonlinear.hpp"
#include "rubato/element/nonlinear/block_sums.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace rubato::element {

constexpr int most_modes_of_cell = 12;

/// Numbers of the cell's own unknowns.
using ModeValues = std::array<double, static_cast<std::size_t>(most_modes_of_cell)>;

class ModeFactor {
public:
  /// Factors the square of a matrix that begins at (first, first).
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

/// K = K_uu − K_uα K_αα⁻¹ K_αu of the nodes' dofs, which come first in `all`; `size` unknowns α follow.
void condense_modes(const MatrixView& all, int node_dofs, int size, const MatrixView& k);

/// Newton's method for the modes: respond() first, then improve() until is_solved().
template <class Respond, class IsSolved, class Improve>
CellResult solve_modes(int most_iterations, const Respond& respond, const IsSolved& is_solved,
                       const Improve& improve) {
  CellResult result = respond();
  for (int i = 0; i < most_iterations && result && !is_solved(); ++i)
    result = improve();
  return result && !is_solved() ? CellResult{Failure::mode_iteration} : result;
}

/// A step of Newton's method for the modes. The step is halved while a law fails or the forces on modes,
/// measured by the inverse of `factor`, grow. `is_stalled` becomes true when no part of the step is better.
template <class Residual, class Respond, class IsSolved>
CellResult improve_modes(const ModeFactor& factor, int size, ModeValues& unknowns, bool& is_stalled,
                         const Residual& residual, const Respond& respond, const IsSolved& is_solved) {
  constexpr int most_halvings = 6;
  const auto solved = [&] {
    ModeValues values = residual();
    factor.solve(values);
    return values;
  };
  const auto level = [&] { return std::abs(dot(residual(), solved(), size)); };
  const ModeValues step = solved();
  const double before = level();
  if (!std::isfinite(before))
    return {Failure::not_finite};
  const ModeValues start = unknowns;
  CellResult result;
  double part = 1;
  for (int i = 0; i <= most_halvings; ++i, part /= 2) {
    for (std::size_t m = 0; m < static_cast<std::size_t>(size); ++m)
      unknowns[m] = start[m] - part * step[m];
    result = respond();
    if (result && (is_solved() || level() < before))
      return result;
  }
  is_stalled = true;
  return result;
}

} // namespace rubato::element
