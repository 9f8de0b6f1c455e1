// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/equilibration.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::linalg {
namespace {

struct LargestMagnitudes {
  Eigen::VectorXd rows;
  Eigen::VectorXd columns;
};

LargestMagnitudes largest_magnitudes(const SparseMatrix& matrix) {
  LargestMagnitudes largest{Eigen::VectorXd::Zero(matrix.rows()), Eigen::VectorXd::Zero(matrix.cols())};
  for (int column = 0; column < matrix.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const auto magnitude = std::abs(entry.value());
      largest.rows[entry.row()] = std::max(largest.rows[entry.row()], magnitude);
      largest.columns[column] = std::max(largest.columns[column], magnitude);
    }
  return largest;
}

/// The power of two nearest to 1/√magnitude.
double root_scale(double magnitude) {
  return std::ldexp(1.0, -static_cast<int>(std::lround(0.5 * std::log2(magnitude))));
}

bool near_one(const Eigen::VectorXd& magnitudes) {
  return magnitudes.minCoeff() > 0.25 && magnitudes.maxCoeff() < 4.0;
}

bool all_finite(const SparseMatrix& matrix) {
  for (int column = 0; column < matrix.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (!std::isfinite(entry.value()))
        return false;
  return true;
}

/// 1 / size, 1 where there is none.
double inverse_of(double size) {
  return size > 0 ? 1 / size : 1.0;
}

} // namespace

std::optional<EquilibratedMatrix> equilibrated(const SparseMatrix& matrix) {
  if (!all_finite(matrix))
    return std::nullopt;
  EquilibratedMatrix result{matrix, Eigen::VectorXd::Ones(matrix.rows()),
                            Eigen::VectorXd::Ones(matrix.cols())};
  result.matrix.makeCompressed();
  // Each sweep halves the spread in magnitude's exponent; ten bring 1e±300 within a factor of four.
  constexpr int sweep_limit = 10;
  for (int sweep = 0; sweep < sweep_limit; ++sweep) {
    const auto largest = largest_magnitudes(result.matrix);
    if (largest.rows.minCoeff() == 0 || largest.columns.minCoeff() == 0)
      return std::nullopt;
    if (near_one(largest.rows) && near_one(largest.columns))
      break;
    const Eigen::VectorXd rows = largest.rows.unaryExpr(&root_scale);
    const Eigen::VectorXd columns = largest.columns.unaryExpr(&root_scale);
    result.matrix = rows.asDiagonal() * result.matrix * columns.asDiagonal();
    result.rows.array() *= rows.array();
    result.columns.array() *= columns.array();
  }
  return result;
}

void equilibrate(Eigen::MatrixXd& matrix, Eigen::VectorXd& rows, Eigen::VectorXd& columns) {
  const Eigen::Index size = matrix.rows();
  rows.setZero(size);
  columns.resize(matrix.cols());
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    double* column = matrix.col(j).data();
    columns[j] = inverse_of(matrix.col(j).lpNorm<Eigen::Infinity>());
    for (Eigen::Index i = 0; i < size; ++i) { // one pass: small matrices of every iteration come here
      column[i] *= columns[j];
      rows[i] = std::max(rows[i], std::abs(column[i]));
    }
  }
  rows = rows.unaryExpr(&inverse_of);
  for (auto column : matrix.colwise())
    column.array() *= rows.array();
}

} // namespace rubato::linalg
