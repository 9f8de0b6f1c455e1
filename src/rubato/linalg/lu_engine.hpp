// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a direct solver of indefinite systems must offer; one file for each library.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <memory>

namespace rubato::linalg {

class LuEngine {
public:
  LuEngine() = default;
  LuEngine(const LuEngine&) = delete;
  LuEngine& operator=(const LuEngine&) = delete;
  virtual ~LuEngine() = default;
  /// `values` holds the right side on entry and the solution on return.
  virtual void solve_in_place(Eigen::VectorXd& values) = 0;
};

/// Each takes an equilibrated, compressed, square matrix that outlives the engine, and gives nullptr when it
/// is singular to working precision (a pivot below `negligible_pivot`). Both throw std::bad_alloc when memory
/// does not suffice.
std::unique_ptr<LuEngine> umfpack_engine(const SparseMatrix& matrix);
std::unique_ptr<LuEngine> mumps_engine(const SparseMatrix& matrix);

/// Factors L D Lᵀ.
struct SymmetricEngine {
  std::unique_ptr<LuEngine> factors;
  int negative_pivots = 0;
};

/// The same of a symmetric matrix, of which the lower triangle is read. It need not outlive the engine.
/// Without factors when it is singular.
SymmetricEngine symmetric_mumps_engine(const SparseMatrix& matrix);

} // namespace rubato::linalg
