// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/constrained_inverse.hpp"

#include "rubato/linalg/dense_cholesky.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
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
    const MatrixXd columns(constraints.middleCols(first, count));
    schur.middleCols(first, count) = constraints.transpose() * factor.solve(columns);
  }
  return (schur + schur.transpose()) / 2;
}

/// Constraints that do not depend on one another, by S scaled to a unit diagonal.
std::vector<int> independent_constraints(const MatrixXd& schur) {
  std::vector<int> columns;
  for (int i = 0; i < schur.cols(); ++i)
    if (schur(i, i) > 0)
      columns.push_back(i);
  const VectorXd scale = schur.diagonal()(columns).cwiseSqrt().cwiseInverse();
  auto independent =
      independent_rows(scale.asDiagonal() * schur(columns, columns) * scale.asDiagonal(), dependent);
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

struct ConstrainedInverse::Dense {
  Eigen::LLT<MatrixXd> schur;   ///< of S
  Eigen::LLT<MatrixXd> lengths; ///< of Cᵀ C
};

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
  inverse.dense_ = std::make_shared<const Dense>(Dense{
      Eigen::LLT<MatrixXd>(MatrixXd(schur(independent, independent))),
      Eigen::LLT<MatrixXd>(MatrixXd(SparseMatrix(inverse.constraints_.transpose() * inverse.constraints_)))});
  return inverse;
}

template <class Vectors> Vectors ConstrainedInverse::solve_constrained(const Vectors& right_sides) const {
  Vectors solution = factor_.solve(right_sides);
  if (constraints_.cols() == 0)
    return solution;
  const MatrixXd reaction = dense_->schur.solve(MatrixXd(constraints_.transpose() * solution));
  return factor_.solve(Vectors(right_sides - constraints_ * reaction));
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
  return force - constraints_ * dense_->lengths.solve(VectorXd(constraints_.transpose() * force));
}

} // namespace rubato::linalg
