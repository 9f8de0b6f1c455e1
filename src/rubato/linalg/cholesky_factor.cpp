// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/cholmod_engine.hpp"
#include "rubato/linalg/direct_solver.hpp"

#include <stdexcept>

namespace rubato::linalg {

struct CholeskyFactor::Engine : CholmodEngine {};

CholeskyFactor::CholeskyFactor(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
CholeskyFactor::CholeskyFactor(CholeskyFactor&&) noexcept = default;
CholeskyFactor& CholeskyFactor::operator=(CholeskyFactor&&) noexcept = default;
CholeskyFactor::~CholeskyFactor() = default;

std::optional<CholeskyFactor> CholeskyFactor::of(const SparseMatrix& matrix) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("CholeskyFactor::of wants a square matrix.");
  LowerTriangle lower(matrix);
  if (!lower.finite)
    return std::nullopt;
  auto engine = std::make_unique<Engine>();
  engine->analyse(lower);
  if (!engine->factorise(lower))
    return std::nullopt;
  return CholeskyFactor(std::move(engine));
}

Eigen::VectorXd CholeskyFactor::solve(const Eigen::VectorXd& right_side) const {
  if (right_side.size() != engine_->order())
    throw std::invalid_argument("CholeskyFactor::solve wants a right side of the matrix's size.");
  return engine_->solve(CHOLMOD_A, right_side);
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_sides) const {
  if (right_sides.rows() != engine_->order())
    throw std::invalid_argument("CholeskyFactor::solve wants right sides of the matrix's size.");
  return engine_->solve_many(right_sides);
}

std::size_t CholeskyFactor::factor_bytes() const {
  return engine_->bytes();
}

} // namespace rubato::linalg
