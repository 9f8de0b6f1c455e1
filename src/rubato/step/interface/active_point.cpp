// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/active_point.hpp"

#include "rubato/core/tolerances.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cstddef>

namespace rubato::step {
namespace {

using Eigen::Dynamic;
using Eigen::Index;

/// Equations of size one that differ by less say the same.
constexpr double no_pivot = 1e-10;

/// dλ = 0 for rows without free dofs.
void fix_unconstrained_multipliers(contact::FactoredResponse& r) {
  const Index d = r.components;
  for (Index row = d; row < d + r.multipliers(); ++row)
    if (r.by_multiplier.row(row).isZero(0) &&
        r.d_du.row(row).lpNorm<Eigen::Infinity>() <=
            tolerances.empty_row * r.interpolation.topRows(d).lpNorm<Eigen::Infinity>()) {
      r.by_multiplier(row, row - d) = 1;
      r.d_du.row(row).setZero();
      r.equations[row - d] = 0;
    }
}

constexpr int sum_of(int a, int b) {
  return a == Dynamic || b == Dynamic ? Dynamic : a + b;
}

/// The work of eliminate_multipliers, compiled for D components and M multipliers of a point, or for any.
template <int D, int M> class Elimination {
public:
  explicit Elimination(ActivePoint& point)
      : point_(point), r_(point.response), d_(r_.components), m_(r_.multipliers()) {}

  void run() {
    Wide combinations = Wide::Identity(d_, d_ + m_);
    if (m_ > 0)
      factor(combinations);
    point_.by_force = combinations.template leftCols<D>(d_);
    point_.right = combinations.template rightCols<M>(m_) * r_.equations.template head<M>(m_);
    auto& left = point_.rows.left;
    left.resize(d_ + r_.n_xi, r_.d_du.cols());
    for (Index q = 0; q < left.cols(); ++q) {
      left.col(q).template head<D>(d_) = -(combinations * r_.d_du.col(q).template head<rows>(d_ + m_));
      left.col(q).tail(r_.n_xi) = -r_.d_du.col(q).tail(r_.n_xi);
    }
    point_.rows.right = r_.interpolation;
  }

private:
  static constexpr int rows = sum_of(D, M);
  /// No more than six of anything.
  template <int Rows, int Columns>
  using Small =
      Eigen::Matrix<double, Rows, Columns, 0, Rows == Dynamic ? 6 : Rows, Columns == Dynamic ? 6 : Columns>;
  using Square = Small<rows, rows>;
  using Tall = Small<rows, M>;
  using Wide = Small<D, rows>;
  using Inverse = Small<M, rows>;
  using Column = Small<rows, 1>;
  using ColumnSizes = Small<M, 1>;

  /// Of Z_m over E_m with rows and columns of order one.
  void factor(Wide& combinations) {
    Tall matrix = r_.by_multiplier;
    const ColumnSizes by_column = inverse_of(ColumnSizes(matrix.cwiseAbs().colwise().maxCoeff()));
    matrix *= by_column.asDiagonal();
    const Column by_row = inverse_of(vector_sizes(matrix));
    matrix = (by_row.asDiagonal() * matrix).eval();
    const Eigen::HouseholderQR<Tall> qr(matrix);
    const Square q = orthogonal_of(qr);
    Inverse inverse = q.template leftCols<M>(m_).transpose();
    qr.matrixQR().template topRows<M>(m_).template triangularView<Eigen::Upper>().solveInPlace(inverse);
    point_.inverse = by_column.asDiagonal() * inverse * by_row.asDiagonal();
    combinations = q.template rightCols<D>(d_).transpose() * by_row.asDiagonal();
  }

  /// Q whole: Eigen's own product of the reflections is not unrolled.
  Square orthogonal_of(const Eigen::HouseholderQR<Tall>& qr) const {
    Square q = Square::Identity(d_ + m_, d_ + m_);
    Column v(d_ + m_);
    for (Index k = m_ - 1; k >= 0; --k) {
      v.setZero();
      v[k] = 1;
      for (Index i = k + 1; i < v.size(); ++i)
        v[i] = qr.matrixQR()(i, k);
      const Column reflected = qr.hCoeffs()[k] * (q.transpose() * v);
      q -= v * reflected.transpose();
    }
    return q;
  }

  /// Sizes of the rows, one for all that are components of one vector: a component that is rounding only must
  /// not be blown up to the size of the others.
  Column vector_sizes(const Tall& matrix) const {
    Column sizes = matrix.cwiseAbs().rowwise().maxCoeff();
    const auto join = [&](Index first, Index count) {
      if (count > 0)
        sizes.segment(first, count).setConstant(sizes.segment(first, count).maxCoeff());
    };
    join(0, d_);
    if (const Index tangents = d_ - 1; m_ >= tangents)
      join(sizes.size() - tangents, tangents);
    return sizes;
  }

  template <class Sizes> static Sizes inverse_of(Sizes sizes) {
    for (auto& size : sizes)
      size = size > 0 ? 1 / size : 1.0;
    return sizes;
  }

  ActivePoint& point_;
  const contact::FactoredResponse& r_;
  Index d_, m_;
};

/// Equations of a point, a right side last.
using Rows = Eigen::Matrix<double, Dynamic, Dynamic, Eigen::RowMajor>;

/// Gauss–Jordan with full pivoting among the unknowns, rows in the order of their pivots. False when some say
/// the same: they are of no use then.
bool reduce(Rows& rows, Index unknowns) {
  std::array<Index, 3> pivots{};
  const Index count = rows.rows();
  for (auto row : rows.rowwise())
    if (const double size = row.head(unknowns).norm(); size > 0)
      row /= size;
  for (Index step = 0; step < count; ++step) {
    Index at = 0;
    Index pivot = 0;
    if (rows.bottomLeftCorner(count - step, unknowns).cwiseAbs().maxCoeff(&at, &pivot) <= no_pivot)
      return false;
    rows.row(step).swap(rows.row(step + at));
    rows.row(step) /= rows(step, pivot);
    for (Index other = 0; other < count; ++other)
      if (other != step)
        rows.row(other) -= rows(other, pivot) * rows.row(step);
    pivots[static_cast<std::size_t>(step)] = pivot;
  }
  std::array<Index, 3> order{0, 1, 2};
  std::sort(order.begin(), order.begin() + count, [&](Index a, Index b) {
    return pivots[static_cast<std::size_t>(a)] < pivots[static_cast<std::size_t>(b)];
  });
  const Rows unordered = rows;
  for (Index row = 0; row < count; ++row)
    rows.row(row) = unordered.row(order[static_cast<std::size_t>(row)]);
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
  point.rows.left << -r.d_du.topRows(d), -r.d_du.bottomRows(r.n_xi);
  point.rows.right = r.interpolation;
}

void reduce_equations(ActivePoint& point, double compliance) {
  const Index d = point.components();
  auto left = point.rows.left.topRows(d);
  const Index unknowns = d + left.cols();
  Rows all(d, unknowns + 1);
  all << point.by_force, compliance * left, point.right;
  if (!reduce(all, unknowns))
    return;
  point.by_force = all.leftCols(d);
  left = all.middleCols(d, left.cols()) / compliance;
  point.right = all.rightCols<1>();
}

contact::PointVector multiplier_change(const ActivePoint& point,
                                       const Eigen::Ref<const Eigen::VectorXd>& force,
                                       const Eigen::VectorXd& moved) {
  const auto& r = point.response;
  const Index d = r.components;
  const Index m = r.multipliers();
  Eigen::Matrix<double, Dynamic, 1, 0, 6, 1> right(d + m);
  right << force, -r.equations;
  for (std::size_t q = 0; q < point.interface_dofs.size(); ++q)
    right -= r.d_du.col(static_cast<Index>(q)).head(d + m) * moved[point.interface_dofs[q]];
  return point.inverse * right;
}

} // namespace rubato::step
