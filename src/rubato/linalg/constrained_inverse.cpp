// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/constrained_inverse.hpp"

#include "rubato/core/transformed.hpp"
#include "rubato/linalg/sparse_products.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Right sides solved together: enough for dense products, few beside the factor's own memory.
constexpr Index columns_at_once = 32;

/// Of a constraint scaled to S_ii = 1: what is left of it beside the others. Rounding of S leaves about 1e-14
/// of one that depends on them; the smoothest and the roughest tractions on a surface differ by 1e-3 or so.
constexpr double dependent = 1e-10;

MatrixXd schur_complement(const CholeskyFactor& factor, const SparseMatrix& constraints) {
  MatrixXd schur(constraints.cols(), constraints.cols());
  for (Index first = 0; first < constraints.cols(); first += columns_at_once) {
    const Index count = std::min(columns_at_once, constraints.cols() - first);
    const MatrixXd columns =
        transposed_product(constraints, factor.solve(dense_columns(constraints, first, count)));
    std::copy_n(columns.data(), columns.size(), schur.data() + first * schur.rows());
  }
  for (Index j = 0; j < schur.cols(); ++j)
    for (Index i = 0; i < j; ++i)
      schur(i, j) = schur(j, i) = (schur(i, j) + schur(j, i)) / 2;
  return schur;
}

MatrixXd chosen_rows_and_columns(const MatrixXd& matrix, const std::vector<int>& chosen) {
  const auto count = static_cast<Index>(chosen.size());
  MatrixXd part(count, count);
  for (Index j = 0; j < count; ++j)
    for (Index i = 0; i < count; ++i)
      part(i, j) = matrix(chosen[static_cast<std::size_t>(i)], chosen[static_cast<std::size_t>(j)]);
  return part;
}

/// Constraints that do not depend on one another, by S scaled to a unit diagonal.
std::vector<int> independent_constraints(const MatrixXd& schur) {
  std::vector<int> columns;
  for (int i = 0; i < schur.cols(); ++i)
    if (schur(i, i) > 0)
      columns.push_back(i);
  auto scaled = chosen_rows_and_columns(schur, columns);
  const auto scale =
      transformed<double>(columns, [&](int column) { return 1 / std::sqrt(schur(column, column)); });
  for (Index j = 0; j < scaled.cols(); ++j)
    for (Index i = 0; i < scaled.rows(); ++i)
      scaled(i, j) = scale[static_cast<std::size_t>(i)] * scaled(i, j) * scale[static_cast<std::size_t>(j)];
  auto independent = independent_rows(std::move(scaled), dependent);
  for (auto& row : independent)
    row = columns[static_cast<std::size_t>(row)];
  return independent;
}

SparseMatrix chosen_columns(const SparseMatrix& matrix, const std::vector<int>& columns) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (SparseMatrix::InnerIterator entry(matrix, columns[j]); entry; ++entry)
      entries.emplace_back(static_cast<int>(entry.row()), static_cast<int>(j), entry.value());
  SparseMatrix chosen(matrix.rows(), static_cast<Index>(columns.size()));
  chosen.setFromTriplets(entries.begin(), entries.end());
  return chosen;
}

} // namespace

ConstrainedInverse::ConstrainedInverse(CholeskyFactor factor) : factor_(std::move(factor)) {}

std::optional<ConstrainedInverse> ConstrainedInverse::of(const SparseMatrix& matrix,
                                                         const SparseMatrix& constraints) {
  if (constraints.cols() > 0 && constraints.rows() != matrix.rows())
    throw std::invalid_argument("ConstrainedInverse::of wants a row of constraints for each unknown.");
  auto factor = CholeskyFactor::of(matrix);
  if (!factor)
    return std::nullopt;
  ConstrainedInverse inverse(std::move(*factor));
  inverse.constraints_.resize(matrix.rows(), 0);
  if (constraints.cols() == 0)
    return inverse;
  const MatrixXd schur = schur_complement(inverse.factor_, constraints);
  const auto independent = independent_constraints(schur);
  inverse.constraints_ = chosen_columns(constraints, independent);
  inverse.schur_.emplace(chosen_rows_and_columns(schur, independent));
  inverse.lengths_.emplace(gram_of_columns(inverse.constraints_));
  return inverse;
}

template <class Vectors> Vectors ConstrainedInverse::solve_constrained(const Vectors& right_sides) const {
  Vectors solution = factor_.solve(right_sides);
  if (constraints_.cols() == 0)
    return solution;
  const Vectors reaction = schur_->solve(transposed_product(constraints_, solution));
  return factor_.solve(Vectors(right_sides - product(constraints_, reaction)));
}

VectorXd ConstrainedInverse::solve(const VectorXd& right_side) const {
  return solve_constrained(right_side);
}

MatrixXd ConstrainedInverse::solve(const MatrixXd& right_sides) const {
  return solve_constrained(right_sides);
}

VectorXd ConstrainedInverse::without_reactions(const VectorXd& force) const {
  if (constraints_.cols() == 0)
    return force;
  return force - product(constraints_, lengths_->solve(transposed_product(constraints_, force)));
}

} // namespace rubato::linalg
