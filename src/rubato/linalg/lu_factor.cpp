// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/direct_solver.hpp"
#include "rubato/linalg/equilibration.hpp"
#include "rubato/linalg/lu_engine.hpp"

#include <stdexcept>

namespace rubato::linalg {
namespace {

/// Below it both take about a millisecond, above it MUMPS is never slower; measured on 2D and 3D elasticity
/// with and without multipliers, up to 20,000 unknowns.
constexpr Eigen::Index largest_order_for_umfpack = 500;

std::unique_ptr<LuEngine> started(GeneralEngine engine, const SparseMatrix& matrix) {
  if (engine == GeneralEngine::automatic)
    engine = matrix.cols() <= largest_order_for_umfpack ? GeneralEngine::umfpack : GeneralEngine::mumps;
  return engine == GeneralEngine::umfpack ? umfpack_engine(matrix) : mumps_engine(matrix);
}

} // namespace

/// The factors of the equilibrated matrix R A C, and R and C.
struct LuFactor::Engine {
  EquilibratedMatrix system;
  std::unique_ptr<LuEngine> factors;
};

LuFactor::LuFactor(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
LuFactor::LuFactor(LuFactor&&) noexcept = default;
LuFactor& LuFactor::operator=(LuFactor&&) noexcept = default;
LuFactor::~LuFactor() = default;

std::optional<LuFactor> LuFactor::of(const SparseMatrix& matrix, GeneralEngine engine) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("LuFactor::of wants a square matrix.");
  if (matrix.cols() == 0)
    return LuFactor(std::make_unique<Engine>());
  auto system = equilibrated(matrix);
  if (!system)
    return std::nullopt;
  auto result = std::make_unique<Engine>(Engine{std::move(*system), nullptr});
  result->factors = started(engine, result->system.matrix);
  if (!result->factors)
    return std::nullopt;
  return LuFactor(std::move(result));
}

Eigen::VectorXd LuFactor::solve(const Eigen::VectorXd& right_side) const {
  const auto& system = engine_->system;
  if (right_side.size() != system.matrix.cols())
    throw std::invalid_argument("LuFactor::solve wants a right side of the matrix's size.");
  if (right_side.size() == 0)
    return {};
  Eigen::VectorXd values = system.rows.cwiseProduct(right_side);
  engine_->factors->solve_in_place(values);
  return system.columns.cwiseProduct(values);
}

} // namespace rubato::linalg
