// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/dual.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace rubato::contact::mortar {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;

/// What the kept nodes have of all functions: a matrix with a row for each of them, in their order.
struct FacetSharing {
  Matrix4d given = Matrix4d::Zero();
  std::array<int, 4> node{};
  int count = 0;
};

FacetSharing share(int node_count, const std::array<bool, 4>& kept) {
  FacetSharing sharing;
  for (int j = 0; j < node_count; ++j)
    if (kept[static_cast<std::size_t>(j)])
      sharing.node[static_cast<std::size_t>(sharing.count++)] = j;
  for (int row = 0; row < sharing.count; ++row)
    for (int j = 0; j < node_count; ++j)
      if (!kept[static_cast<std::size_t>(j)])
        sharing.given(row, j) = 1. / sharing.count;
      else if (sharing.node[static_cast<std::size_t>(row)] == j)
        sharing.given(row, j) = 1;
  return sharing;
}

/// The Cholesky factor of the first rows of a symmetric matrix, below its diagonal; false where there is
/// none.
bool factor(int size, Matrix4d& m) {
  for (int k = 0; k < size; ++k) {
    double pivot = m(k, k);
    for (int j = 0; j < k; ++j)
      pivot -= m(k, j) * m(k, j);
    if (pivot <= 0)
      return false;
    m(k, k) = std::sqrt(pivot);
    for (int i = k + 1; i < size; ++i) {
      for (int j = 0; j < k; ++j)
        m(i, k) -= m(i, j) * m(k, j);
      m(i, k) /= m(k, k);
    }
  }
  return true;
}

/// Solves L Lᵀ x = b for one column of b, which is replaced by x.
void solve(int size, const Matrix4d& factor, Matrix4d& b, int column) {
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < i; ++j)
      b(i, column) -= factor(i, j) * b(j, column);
    b(i, column) /= factor(i, i);
  }
  for (int i = size - 1; i >= 0; --i) {
    for (int j = i + 1; j < size; ++j)
      b(i, column) -= factor(j, i) * b(j, column);
    b(i, column) /= factor(i, i);
  }
}

/// G v and G M Gᵀ of the kept nodes; zeros past their count.
Vector4d times(const FacetSharing& sharing, const Vector4d& v) {
  Vector4d product(0, 0, 0, 0);
  for (int i = 0; i < sharing.count; ++i)
    for (int j = 0; j < 4; ++j)
      product[i] += sharing.given(i, j) * v[j];
  return product;
}

Matrix4d between_kept(const FacetSharing& sharing, const Matrix4d& m) {
  Matrix4d product;
  product.setZero();
  for (int i = 0; i < sharing.count; ++i) {
    Vector4d row(0, 0, 0, 0);
    for (int k = 0; k < 4; ++k)
      for (int j = 0; j < 4; ++j)
        row[j] += sharing.given(i, k) * m(k, j);
    for (int l = 0; l < sharing.count; ++l)
      for (int j = 0; j < 4; ++j)
        product(i, l) += row[j] * sharing.given(l, j);
  }
  return product;
}

/// diag(De) Me⁻¹ G, or G where Me cannot be inverted: slivers and areas that a fan takes back.
Matrix4d dual_rows(const FacetSharing& sharing, const FacetMoments& covered) {
  if (sharing.count == 1)
    return sharing.given; // ΣH = 1: one function is its own dual
  const auto first = times(sharing, covered.first);
  auto second = between_kept(sharing, covered.second);
  if (!factor(sharing.count, second))
    return sharing.given;
  Matrix4d dual = sharing.given;
  bool finite = true;
  for (int column = 0; column < 4; ++column) {
    solve(sharing.count, second, dual, column);
    for (int i = 0; i < sharing.count; ++i) {
      dual(i, column) *= first[i];
      finite = finite && std::isfinite(dual(i, column));
    }
  }
  return finite ? dual : sharing.given;
}

} // namespace

Matrix4d dual_coefficients(int node_count, const FacetMoments& covered, double full_area,
                           const std::array<bool, 4>& kept) {
  const auto sharing = share(node_count, kept);
  if (sharing.count == 0)
    return Matrix4d::Zero();
  const bool sliver = !(total_of(covered.first) >= least_dual_cover * full_area);
  const Matrix4d rows = sliver ? sharing.given : dual_rows(sharing, covered);
  Matrix4d coefficients;
  coefficients.setZero();
  for (int row = 0; row < sharing.count; ++row)
    for (int j = 0; j < 4; ++j)
      coefficients(sharing.node[static_cast<std::size_t>(row)], j) = rows(row, j);
  return coefficients;
}

namespace {

/// Of the sub-facet's size.
constexpr double extrapolated = 0.1;

} // namespace

LeastGaps::LeastGaps(int node_count, const FacetMoments& covered, const Matrix4d& dual,
                     const Vector4d& first_gap) {
  const double whole = total_of(covered.first);
  for (int i = 0; i < node_count; ++i)
    for (int j = 0; j < 4; ++j) {
      fit_(i, j) = covered.first[i] > 0 ? dual(i, j) / covered.first[i] : 1 / whole;
      fitted_[i] += fit_(i, j) * first_gap[j];
    }
}

void LeastGaps::see(const Vector4d& values, double gap) {
  if (gap < least_) {
    least_ = gap;
    least_seen_ = seen_;
  }
  ++seen_;
  if (const double fitted = dot(fitted_, values); fitted < least_fitted_) {
    least_fitted_ = fitted;
    values_at_least_fitted_ = values;
  }
}

LeastGaps::Bound LeastGaps::bound(int node, double size) const {
  Bound bound;
  bound.by_least = least_ < 0 ? 2 : 1;
  bound.value = bound.by_least * least_;
  const double below = least_fitted_ - fitted_[node];
  if (below > 0)
    bound.value -= std::min(below, extrapolated * size);
  if (below > 0 && below < extrapolated * size)
    for (int j = 0; j < 4; ++j) {
      double at_least = 0;
      for (int i = 0; i < 4; ++i)
        at_least += fit_(i, j) * values_at_least_fitted_[i];
      bound.row[j] = fit_(node, j) - at_least;
    }
  return bound;
}

Vector4d kept_areas(int node_count, const FacetMoments& covered, const std::array<bool, 4>& kept) {
  const auto sharing = share(node_count, kept);
  const auto rows = times(sharing, covered.first);
  Vector4d areas(0, 0, 0, 0);
  for (int row = 0; row < sharing.count; ++row)
    areas[sharing.node[static_cast<std::size_t>(row)]] = rows[row];
  return areas;
}

} // namespace rubato::contact::mortar
