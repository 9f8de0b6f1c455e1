// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/direct_solver.hpp"
#include "rubato/linalg/equilibration.hpp"
#include "rubato/linalg/lu_engine.hpp"

#include <stdexcept>
#include <utility>

namespace rubato::linalg {

/// The factors of the equilibrated matrix C A C, which has as many negative eigenvalues as A, and C.
struct SymmetricFactor::Engine {
  Eigen::VectorXd scales;
  SymmetricEngine symmetric;
};

SymmetricFactor::SymmetricFactor(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;
SymmetricFactor::~SymmetricFactor() = default;

std::optional<SymmetricFactor> SymmetricFactor::of(const SparseMatrix& matrix) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("SymmetricFactor::of wants a square matrix.");
  if (matrix.cols() == 0)
    return SymmetricFactor(std::make_unique<Engine>());
  // Rows and columns get the same scales only where both triangles agree to the last bit.
  const auto system = equilibrated(matrix.selfadjointView<Eigen::Lower>());
  if (!system)
    return std::nullopt;
  auto symmetric = symmetric_mumps_engine(system->matrix);
  if (!symmetric.factors)
    return std::nullopt;
  return SymmetricFactor(std::make_unique<Engine>(Engine{system->columns, std::move(symmetric)}));
}

Eigen::VectorXd SymmetricFactor::solve(const Eigen::VectorXd& right_side) const {
  if (right_side.size() != engine_->scales.size())
    throw std::invalid_argument("SymmetricFactor::solve wants a right side of the matrix's size.");
  if (right_side.size() == 0)
    return {};
  Eigen::VectorXd values = engine_->scales.cwiseProduct(right_side);
  engine_->symmetric.factors->solve_in_place(values);
  return engine_->scales.cwiseProduct(values);
}

int SymmetricFactor::negative_pivots() const {
  return engine_->symmetric.negative_pivots;
}

} // namespace rubato::linalg
