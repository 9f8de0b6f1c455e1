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

Eigen::VectorXd root_scales(const Eigen::VectorXd& magnitudes) {
  Eigen::VectorXd scales(magnitudes.size());
  for (Eigen::Index i = 0; i < scales.size(); ++i)
    scales[i] = root_scale(magnitudes[i]);
  return scales;
}

void multiply(const Eigen::VectorXd& factors, Eigen::VectorXd& values) {
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values[i] *= factors[i];
}

bool near_one(const Eigen::VectorXd& magnitudes) {
  return std::ranges::all_of(magnitudes, [](double size) { return size > 0.25 && size < 4.0; });
}

bool has_zero(const Eigen::VectorXd& magnitudes) {
  return std::ranges::find(magnitudes, 0.0) != magnitudes.end();
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
    if (has_zero(largest.rows) || has_zero(largest.columns))
      return std::nullopt;
    if (near_one(largest.rows) && near_one(largest.columns))
      break;
    const auto rows = root_scales(largest.rows);
    const auto columns = root_scales(largest.columns);
    for (int column = 0; column < matrix.cols(); ++column)
      for (SparseMatrix::InnerIterator entry(result.matrix, column); entry; ++entry)
        entry.valueRef() = rows[entry.row()] * entry.value() * columns[column];
    multiply(rows, result.rows);
    multiply(columns, result.columns);
  }
  return result;
}

void equilibrate(Eigen::MatrixXd& matrix, Eigen::VectorXd& rows, Eigen::VectorXd& columns) {
  const Eigen::Index size = matrix.rows();
  rows.setZero(size);
  columns.resize(matrix.cols());
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    double* column = matrix.col(j).data();
    double size_of_column = 0;
    for (Eigen::Index i = 0; i < size; ++i)
      size_of_column = std::max(size_of_column, std::abs(column[i]));
    columns[j] = inverse_of(size_of_column);
    for (Eigen::Index i = 0; i < size; ++i) { // one pass: small matrices of every iteration come here
      column[i] *= columns[j];
      rows[i] = std::max(rows[i], std::abs(column[i]));
    }
  }
  for (double& row : rows)
    row = inverse_of(row);
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    double* column = matrix.col(j).data();
    for (Eigen::Index i = 0; i < size; ++i)
      column[i] *= rows[i];
  }
}

} // namespace rubato::linalg
