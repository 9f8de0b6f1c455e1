// SPDX-License-Identifier: LGPL-3.0-or-later
/// CHOLMOD behind the Cholesky factors of this module. With long indices throughout: a factor of more than
/// 2^31 entries then needs no second path.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <suitesparse/cholmod.h>
#include <vector>

namespace rubato::linalg {

/// The lower triangle of a matrix, in arrays CHOLMOD can read.
struct LowerTriangle {
  using Index = SuiteSparse_long;
  std::vector<Index> starts;
  std::vector<Index> rows;
  std::vector<double> values;
  bool finite = true;
  bool sorted = true;

  explicit LowerTriangle(const SparseMatrix& matrix);
  /// Of the rows and columns `unknowns`, in that order. `number`: of each unknown its place among them; it
  /// must have no entries outside.
  LowerTriangle(const SparseMatrix& matrix, std::span<const int> unknowns, std::span<const int> number);

  Index size() const { return static_cast<Index>(starts.size()) - 1; }
  cholmod_sparse view();
  /// In the order of the unknowns; zero where the diagonal is not stored.
  std::vector<double> diagonal() const;
};

/// The lower triangle of the last rows and columns of a factor, column by column.
struct TrailingTriangle {
  const double* values = nullptr; ///< points into the factor or into `copy`
  Eigen::Index size = 0;
  Eigen::Index stride = 1;
  Eigen::MatrixXd copy;
};

/// A supernode of a factor: columns that share the pattern of their rows, stored as one dense block.
struct Supernode {
  SuiteSparse_long first = 0; ///< of its columns
  SuiteSparse_long columns = 0;
  std::span<const SuiteSparse_long> rows; ///< its columns first
  const double* values = nullptr;         ///< column by column; none before there are values
};

/// CHOLMOD's settings, one factor L Lᵀ, and the work vectors that repeated solves reuse. An empty matrix has
/// no factor. Everything throws std::bad_alloc when memory does not suffice.
class CholmodEngine {
public:
  using Index = SuiteSparse_long;

  CholmodEngine();
  CholmodEngine(const CholmodEngine&) = delete;
  CholmodEngine& operator=(const CholmodEngine&) = delete;
  ~CholmodEngine();

  /// Orders the unknowns by METIS and finds where the factor has entries.
  void analyse(LowerTriangle& lower);
  /// The same, with supernodes even where these do not pay.
  void analyse_supernodes(LowerTriangle& lower);
  /// The same, with the last `trailing` unknowns eliminated last, as they stand.
  void analyse(LowerTriangle& lower, Index trailing);
  /// Memory of the analysed factor, whether it has its values yet or not.
  std::size_t bytes() const;
  /// Of the analysed factor, from the entries c_j of its columns: their number Σ c_j, and the multiplications
  /// and additions Σ c_j² that its values take. Zeros that supernodes store besides are not counted.
  double entries() const { return entries_; }
  double flops() const { return flops_; }
  /// False when the matrix is not positive definite to working precision. May be called again with other
  /// values on the same pattern, after a failure too: the factor's memory is used again.
  bool factorise(LowerTriangle& lower);

  Eigen::Index order() const { return factor_ == nullptr ? 0 : static_cast<Eigen::Index>(factor_->n); }
  /// Of the unknowns, in the order of elimination.
  std::span<const Index> permutation() const;
  TrailingTriangle trailing(Index size) const;
  /// 0 of a factor without supernodes.
  std::size_t supernode_count() const;
  Supernode supernode(std::size_t s) const;

  /// `system`: CHOLMOD_A, or CHOLMOD_L and CHOLMOD_Lt on vectors in the order of elimination. What comes back
  /// lasts until the next call.
  Eigen::Map<const Eigen::VectorXd> solve(int system, const Eigen::Ref<const Eigen::VectorXd>& right_side);
  Eigen::MatrixXd solve_many(const Eigen::MatrixXd& right_sides);

private:
  void analyse(LowerTriangle& lower, int supernodal);
  void take_analysed(cholmod_factor* factor);
  std::vector<Index> interior_ordering(LowerTriangle& lower, Index trailing);

  cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* solution_ = nullptr;
  cholmod_dense* work_y_ = nullptr;
  cholmod_dense* work_e_ = nullptr;
  double entries_ = 0;
  double flops_ = 0;
};

} // namespace rubato::linalg
