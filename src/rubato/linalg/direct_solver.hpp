// SPDX-License-Identifier: LGPL-3.0-or-later
/// The only module that knows CHOLMOD, UMFPACK and MUMPS: factor and solve sparse systems.
#pragma once

#include "rubato/linalg/sparse_matrix.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <memory>
#include <optional>

namespace rubato::linalg {

// Factoring and solving throw std::invalid_argument when sizes do not match and std::bad_alloc when memory
// does not suffice. A factor keeps work space, so one factor is used by one thread at a time; MUMPS wants
// that of the whole process. OpenBLAS is held to one thread unless OPENBLAS_NUM_THREADS or OMP_NUM_THREADS
// says otherwise.

/// Cholesky factor of a symmetric positive definite matrix (CHOLMOD, supernodal, METIS ordering).
class CholeskyFactor {
public:
  /// `matrix` holds both triangles; only the lower one is read. Nothing comes back when the matrix is not
  /// positive definite to working precision or has a value that is not finite.
  static std::optional<CholeskyFactor> of(const SparseMatrix& matrix);
  CholeskyFactor(CholeskyFactor&&) noexcept;
  CholeskyFactor& operator=(CholeskyFactor&&) noexcept;
  ~CholeskyFactor();

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  /// One column for each right side.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_sides) const;
  /// Memory the factor holds.
  std::size_t factor_bytes() const;

private:
  struct Engine;
  explicit CholeskyFactor(std::unique_ptr<Engine> engine);
  std::unique_ptr<Engine> engine_;
};

/// Which unsymmetric engine works: UMFPACK on small systems, MUMPS on large ones.
enum class GeneralEngine { automatic, umfpack, mumps };

/// LU factors of a square, possibly indefinite and unsymmetric matrix.
class LuFactor {
public:
  /// Nothing comes back when the matrix is singular to working precision or has a value that is not finite.
  static std::optional<LuFactor> of(const SparseMatrix& matrix,
                                    GeneralEngine engine = GeneralEngine::automatic);
  LuFactor(LuFactor&&) noexcept;
  LuFactor& operator=(LuFactor&&) noexcept;
  ~LuFactor();

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;

private:
  struct Engine;
  explicit LuFactor(std::unique_ptr<Engine> engine);
  std::unique_ptr<Engine> engine_;
};

/// Factors L D Lᵀ of a symmetric, possibly indefinite matrix, D with blocks of one and two rows (MUMPS). They
/// take half the arithmetic of LuFactor, and tell how many eigenvalues are negative.
class SymmetricFactor {
public:
  /// `matrix` holds both triangles; only the lower one is read. Nothing comes back when the matrix is
  /// singular to working precision or has a value that is not finite.
  static std::optional<SymmetricFactor> of(const SparseMatrix& matrix);
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;
  ~SymmetricFactor();

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  /// How many eigenvalues of the matrix are negative (Sylvester's law of inertia).
  int negative_pivots() const;

private:
  struct Engine;
  explicit SymmetricFactor(std::unique_ptr<Engine> engine);
  std::unique_ptr<Engine> engine_;
};

} // namespace rubato::linalg
