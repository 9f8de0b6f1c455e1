// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/active_point.hpp"

#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Dynamic;
using Eigen::Index;

/// Equations of size one that differ by less say the same.
constexpr double no_pivot = 1e-10;

template <class Matrix> bool is_zero_row(const Matrix& matrix, Index row) {
  for (Index column = 0; column < matrix.cols(); ++column)
    if (matrix(row, column) != 0)
      return false;
  return true;
}

template <class Matrix> double largest_of_rows(const Matrix& matrix, Index count) {
  double largest = 0;
  for (Index row = 0; row < count; ++row)
    largest = std::max(largest, largest_of_row(matrix, row));
  return largest;
}

/// dλ = 0 for rows without free dofs.
void fix_unconstrained_multipliers(contact::FactoredResponse& r) {
  const Index d = r.components;
  for (Index row = d; row < d + r.multipliers(); ++row)
    if (is_zero_row(r.by_multiplier, row) &&
        largest_of_row(r.d_du, row) <= tolerances.empty_row * largest_of_rows(r.interpolation, d)) {
      r.by_multiplier(row, row - d) = 1;
      for (Index q = 0; q < r.d_du.cols(); ++q)
        r.d_du(row, q) = 0;
      r.equations[row - d] = 0;
    }
}

/// No more rows than three of forces and three of multipliers.
constexpr Index most_rows = 6;
/// Column by column. Plain loops: libraries' templates for matrices this small take long to compile.
using Small = std::array<std::array<double, most_rows>, most_rows>;

/// The work of eliminate_multipliers, compiled for D components and M multipliers of a point, or for any: by
/// an orthogonal factorisation, with reflections (A. Householder, J. ACM 5 (1958) 339–342).
template <int D, int M> class Elimination {
public:
  explicit Elimination(ActivePoint& point) : point_(point), r_(point.response) {}

  void run() {
    if (m() > 0) {
      scale();
      reflect();
      form_orthogonal();
      invert();
    }
    combine();
  }

private:
  Index d() const { return D == Dynamic ? r_.components : D; }
  Index m() const { return M == Dynamic ? r_.multipliers() : M; }
  Index rows() const { return d() + m(); }

  static double inverse_of(double size) { return size > 0 ? 1 / size : 1.0; }

  /// Z_m over E_m with rows and columns of order one.
  void scale() {
    for (Index j = 0; j < m(); ++j) {
      double size = 0;
      for (Index i = 0; i < rows(); ++i)
        size = std::max(size, std::abs(r_.by_multiplier(i, j)));
      by_column_[j] = inverse_of(size);
      for (Index i = 0; i < rows(); ++i)
        matrix_[j][i] = r_.by_multiplier(i, j) * by_column_[j];
    }
    for (Index i = 0; i < rows(); ++i) {
      by_row_[i] = 0;
      for (Index j = 0; j < m(); ++j)
        by_row_[i] = std::max(by_row_[i], std::abs(matrix_[j][i]));
    }
    join_sizes(0, d());
    if (const Index tangents = d() - 1; m() >= tangents)
      join_sizes(rows() - tangents, tangents);
    for (Index i = 0; i < rows(); ++i) {
      by_row_[i] = inverse_of(by_row_[i]);
      for (Index j = 0; j < m(); ++j)
        matrix_[j][i] *= by_row_[i];
    }
  }

  /// One size for rows that are components of one vector: a component that is rounding only must not be blown
  /// up to the size of the others.
  void join_sizes(Index first, Index count) {
    double size = 0;
    for (Index i = first; i < first + count; ++i)
      size = std::max(size, by_row_[i]);
    for (Index i = first; i < first + count; ++i)
      by_row_[i] = size;
  }

  /// R above the diagonal, each reflection 1 − τ v vᵀ below it, where v begins with 1.
  void reflect() {
    for (Index k = 0; k < m(); ++k) {
      auto& column = matrix_[k];
      double tail = 0;
      for (Index i = k + 1; i < rows(); ++i)
        tail += column[i] * column[i];
      tau_[k] = 0;
      if (tail > std::numeric_limits<double>::min()) {
        const double head = column[k];
        const double length = std::sqrt(head * head + tail);
        column[k] = head >= 0 ? -length : length;
        for (Index i = k + 1; i < rows(); ++i)
          column[i] /= head - column[k];
        tau_[k] = (column[k] - head) / column[k];
      }
      for (Index j = k + 1; j < m(); ++j)
        apply_reflection(k, matrix_[j]);
    }
  }

  /// Its v stands below the diagonal of column k.
  void apply_reflection(Index k, std::array<double, most_rows>& to) const {
    const auto& v = matrix_[k];
    double along = to[k];
    for (Index i = k + 1; i < rows(); ++i)
      along += v[i] * to[i];
    along *= tau_[k];
    to[k] -= along;
    for (Index i = k + 1; i < rows(); ++i)
      to[i] -= along * v[i];
  }

  void form_orthogonal() {
    for (Index j = 0; j < rows(); ++j) {
      for (Index i = 0; i < rows(); ++i)
        orthogonal_[j][i] = i == j ? 1 : 0;
      for (Index k = m() - 1; k >= 0; --k)
        apply_reflection(k, orthogonal_[j]);
    }
  }

  /// R⁻¹ times the first rows of Qᵀ, back to unscaled rows and columns.
  void invert() {
    point_.inverse.resize(m(), rows());
    for (Index c = 0; c < rows(); ++c)
      for (Index i = m() - 1; i >= 0; --i) {
        double sum = orthogonal_[i][c];
        for (Index j = i + 1; j < m(); ++j)
          sum -= matrix_[j][i] * solution_[j];
        solution_[i] = sum / matrix_[i][i];
        point_.inverse(i, c) = by_column_[i] * solution_[i] * by_row_[c];
      }
  }

  /// Of the equations, a row each: the last columns of Q; all of them where there are no multipliers.
  double combination(Index row, Index equation) const {
    return m() > 0 ? orthogonal_[m() + row][equation] * by_row_[equation] : (row == equation ? 1.0 : 0.0);
  }

  void combine() {
    for (Index row = 0; row < d(); ++row)
      for (Index e = 0; e < rows(); ++e)
        combinations_[e][row] = combination(row, e);
    point_.by_force.resize(d(), d());
    point_.right.resize(d());
    for (Index row = 0; row < d(); ++row) {
      for (Index c = 0; c < d(); ++c)
        point_.by_force(row, c) = combinations_[c][row];
      point_.right[row] = 0;
      for (Index j = 0; j < m(); ++j)
        point_.right[row] += combinations_[d() + j][row] * r_.equations[j];
    }
    auto& left = point_.rows.left;
    left.resize(d() + r_.n_xi, r_.d_du.cols());
    for (Index q = 0; q < left.cols(); ++q) {
      const double* column = r_.d_du.data() + q * r_.d_du.rows();
      for (Index row = 0; row < d(); ++row) {
        double sum = 0;
        for (Index e = 0; e < rows(); ++e)
          sum += combinations_[e][row] * column[e];
        left(row, q) = -sum;
      }
      for (Index slope = 0; slope < r_.n_xi; ++slope)
        left(d() + slope, q) = -column[r_.d_du.rows() - r_.n_xi + slope];
    }
    point_.rows.right = r_.interpolation;
  }

  ActivePoint& point_;
  const contact::FactoredResponse& r_;
  Small matrix_, orthogonal_, combinations_;
  std::array<double, most_rows> by_row_, by_column_, tau_, solution_;
};

/// Equations of a point, a row each, a right side last.
class EquationRows {
public:
  EquationRows(Index count, Index columns)
      : count_(count), columns_(columns), values_(static_cast<std::size_t>(count * columns)) {}

  Index count() const { return count_; }
  Index columns() const { return columns_; }
  double* row(Index row) { return values_.data() + row * columns_; }

  void divide(Index row, double by) {
    for (Index c = 0; c < columns_; ++c)
      this->row(row)[c] /= by;
  }
  void swap(Index a, Index b) {
    if (a != b)
      std::swap_ranges(row(a), row(a) + columns_, row(b));
  }
  /// Subtracts a multiple of another row.
  void subtract(double factor, Index other, Index from) {
    const double* const by = row(other);
    double* const to = row(from);
    for (Index c = 0; c < columns_; ++c)
      to[c] -= factor * by[c];
  }

private:
  Index count_;
  Index columns_;
  std::vector<double> values_;
};

/// Gauss–Jordan with full pivoting among the unknowns, rows in the order of their pivots. False when some say
/// the same: they are of no use then.
bool reduce(EquationRows& rows, Index unknowns) {
  std::array<Index, 3> pivots{};
  const Index count = rows.count();
  for (Index row = 0; row < count; ++row) {
    double square = 0;
    for (Index c = 0; c < unknowns; ++c)
      square += rows.row(row)[c] * rows.row(row)[c];
    if (square > 0)
      rows.divide(row, std::sqrt(square));
  }
  for (Index step = 0; step < count; ++step) {
    Index at = step;
    Index pivot = 0;
    for (Index row = step; row < count; ++row)
      for (Index c = 0; c < unknowns; ++c)
        if (std::abs(rows.row(row)[c]) > std::abs(rows.row(at)[pivot])) {
          at = row;
          pivot = c;
        }
    if (std::abs(rows.row(at)[pivot]) <= no_pivot)
      return false;
    rows.swap(step, at);
    rows.divide(step, double{rows.row(step)[pivot]});
    for (Index other = 0; other < count; ++other)
      if (other != step)
        rows.subtract(double{rows.row(other)[pivot]}, step, other);
    pivots[static_cast<std::size_t>(step)] = pivot;
  }
  for (Index row = 0; row < count; ++row) // selection: three rows at most
    for (Index other = row + 1; other < count; ++other)
      if (auto& a = pivots[static_cast<std::size_t>(row)], &b = pivots[static_cast<std::size_t>(other)];
          b < a) {
        std::swap(a, b);
        rows.swap(row, other);
      }
  return true;
}

} // namespace

void eliminate_multipliers(ActivePoint& point) {
  auto& r = point.response;
  fix_unconstrained_multipliers(r);
  if (r.components == 3 && r.multipliers() == 3)
    Elimination<3, 3>(point).run();
  else if (r.components == 2 && r.multipliers() == 2)
    Elimination<2, 2>(point).run();
  else
    Elimination<Dynamic, Dynamic>(point).run();
}

void keep_multipliers(ActivePoint& point) {
  const auto& r = point.response;
  const Index d = r.components;
  point.by_force.setIdentity(d, d);
  point.right.setZero(d);
  point.rows.left.resize(d + r.n_xi, r.d_du.cols());
  const Index slopes = r.d_du.rows() - r.n_xi;
  for (Index q = 0; q < r.d_du.cols(); ++q) {
    for (Index row = 0; row < d; ++row)
      point.rows.left(row, q) = -r.d_du(row, q);
    for (Index slope = 0; slope < r.n_xi; ++slope)
      point.rows.left(d + slope, q) = -r.d_du(slopes + slope, q);
  }
  point.rows.right = r.interpolation;
}

void reduce_equations(ActivePoint& point, double compliance) {
  const Index d = point.components();
  auto& left = point.rows.left;
  const Index unknowns = d + left.cols();
  EquationRows all(d, unknowns + 1);
  for (Index row = 0; row < d; ++row) {
    double* const to = all.row(row);
    for (Index c = 0; c < d; ++c)
      to[c] = point.by_force(row, c);
    for (Index q = 0; q < left.cols(); ++q)
      to[d + q] = compliance * left(row, q);
    to[unknowns] = point.right[row];
  }
  if (!reduce(all, unknowns))
    return;
  for (Index row = 0; row < d; ++row) {
    const double* const from = all.row(row);
    for (Index c = 0; c < d; ++c)
      point.by_force(row, c) = from[c];
    for (Index q = 0; q < left.cols(); ++q)
      left(row, q) = from[d + q] / compliance;
    point.right[row] = from[unknowns];
  }
}

contact::PointVector multiplier_change(const ActivePoint& point, std::span<const double> force,
                                       const Eigen::VectorXd& moved) {
  const auto& r = point.response;
  const Index d = r.components;
  const Index m = r.multipliers();
  std::array<double, most_rows> right{};
  for (Index row = 0; row < d + m; ++row)
    right[static_cast<std::size_t>(row)] =
        row < d ? force[static_cast<std::size_t>(row)] : -r.equations[row - d];
  for (std::size_t q = 0; q < point.interface_dofs.size(); ++q) {
    const double by = moved[point.interface_dofs[q]];
    for (Index row = 0; row < d + m; ++row)
      right[static_cast<std::size_t>(row)] -= r.d_du(row, static_cast<Index>(q)) * by;
  }
  contact::PointVector change(m);
  for (Index row = 0; row < m; ++row) {
    change[row] = 0;
    for (Index c = 0; c < d + m; ++c)
      change[row] += point.inverse(row, c) * right[static_cast<std::size_t>(c)];
  }
  return change;
}

} // namespace rubato::step
