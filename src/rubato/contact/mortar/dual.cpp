// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/dual.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
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

/// diag(De) Me⁻¹ G, or G where Me cannot be inverted: slivers and areas that a fan takes back.
template <int Size> Matrix4d dual_of(const FacetSharing& sharing, const FacetMoments& covered) {
  using Square = Eigen::Matrix<double, Size, Size>;
  const auto given = sharing.given.topRows<Size>();
  const Eigen::Vector<double, Size> first = given * covered.first;
  const Square second = given * covered.second * given.transpose();
  const Eigen::LLT<Square> factor(second);
  Matrix4d coefficients = Matrix4d::Zero();
  coefficients.topRows<Size>() = given;
  if (factor.info() != Eigen::Success)
    return coefficients;
  const Eigen::Matrix<double, Size, 4> inverse = factor.solve(given);
  const Eigen::Matrix<double, Size, 4> dual = first.asDiagonal() * inverse;
  if (dual.allFinite())
    coefficients.topRows<Size>() = dual;
  return coefficients;
}

Matrix4d dual_rows(const FacetSharing& sharing, const FacetMoments& covered) {
  switch (sharing.count) {
  case 1:
    return sharing.given; // ΣH = 1: one function is its own dual
  case 2:
    return dual_of<2>(sharing, covered);
  case 3:
    return dual_of<3>(sharing, covered);
  default:
    return dual_of<4>(sharing, covered);
  }
}

} // namespace

Matrix4d dual_coefficients(int node_count, const FacetMoments& covered, double full_area,
                           const std::array<bool, 4>& kept) {
  const auto sharing = share(node_count, kept);
  if (sharing.count == 0)
    return Matrix4d::Zero();
  const bool sliver = !(covered.first.sum() >= least_dual_cover * full_area);
  const Matrix4d rows = sliver ? sharing.given : dual_rows(sharing, covered);
  Matrix4d coefficients = Matrix4d::Zero();
  for (int row = 0; row < sharing.count; ++row)
    coefficients.row(sharing.node[static_cast<std::size_t>(row)]) = rows.row(row);
  return coefficients;
}

namespace {

/// Of the sub-facet's size.
constexpr double extrapolated = 0.1;

} // namespace

LeastGaps::LeastGaps(int node_count, const FacetMoments& covered, const Matrix4d& dual,
                     const Vector4d& first_gap) {
  for (int i = 0; i < node_count; ++i)
    if (covered.first[i] > 0)
      fit_.row(i) = dual.row(i) / covered.first[i];
    else
      fit_.row(i).setConstant(1 / covered.first.sum());
  fitted_ = fit_ * first_gap;
}

void LeastGaps::see(const Vector4d& values, double gap) {
  if (gap < least_) {
    least_ = gap;
    least_seen_ = seen_;
  }
  ++seen_;
  if (const double fitted = fitted_.dot(values); fitted < least_fitted_) {
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
    bound.row = fit_.row(node).transpose() - fit_.transpose() * values_at_least_fitted_;
  return bound;
}

Vector4d kept_areas(int node_count, const FacetMoments& covered, const std::array<bool, 4>& kept) {
  const auto sharing = share(node_count, kept);
  const Vector4d rows = sharing.given * covered.first;
  Vector4d areas = Vector4d::Zero();
  for (int row = 0; row < sharing.count; ++row)
    areas[sharing.node[static_cast<std::size_t>(row)]] = rows[row];
  return areas;
}

} // namespace rubato::contact::mortar
