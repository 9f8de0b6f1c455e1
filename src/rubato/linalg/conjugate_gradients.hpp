// SPDX-License-Identifier: LGPL-3.0-or-later
/// Conjugate gradients with a multigrid preconditioner, of a library that is loaded only when a study asks
/// for it. Sources in petsc/ are that library's side: they include this header and nothing else of rubato.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace rubato::linalg {

/// A symmetric matrix by its rows, and what its softest motions look like.
struct MatrixByRows {
  int size = 0;
  int block = 1; ///< rows that belong to one node, which follow one another
  std::vector<int> entries_of_row;
  /// Puts the columns and values of a row in place of what the lists had.
  std::function<void(int row, std::vector<int>& columns, std::vector<double>& values)> row;
  Eigen::MatrixXd near_null; ///< orthonormal columns, which the matrix nearly maps to zero
};

class ConjugateGradients {
public:
  enum class Ending {
    solved,
    indefinite, ///< the matrix is not positive definite
    unfinished  ///< too many iterations, or a value that is not finite
  };
  struct Outcome {
    Ending ending = Ending::unfinished;
    int iterations = 0;
    double left = 0; ///< |b − A x| by the recurrence, of |b|
  };

  ConjugateGradients() = default;
  ConjugateGradients(const ConjugateGradients&) = delete;
  ConjugateGradients& operator=(const ConjugateGradients&) = delete;
  virtual ~ConjugateGradients() = default;

  /// Builds the preconditioner of another matrix, from nothing: what it is does not depend on the last one.
  /// Throws std::bad_alloc where memory does not suffice, std::runtime_error where the library fails
  /// otherwise.
  virtual void set(const MatrixByRows& matrix) = 0;
  /// x = A⁻¹ b from x = 0 to a residual of `tolerance` |b|, b not zero and x of its size. Throws as `set`
  /// does.
  virtual Outcome solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance,
                        int most_iterations) = 0;
};

/// What the library's side exports by the name below, in C linkage. The number counts changes of this header.
using MakeConjugateGradients = void(std::unique_ptr<ConjugateGradients>& made, bool of_all_ranks);
inline constexpr const char* make_conjugate_gradients_name = "rubato_make_conjugate_gradients_2";

/// Loads the library where that has not happened yet. `of_all_ranks`: rows are dealt out to all ranks, each
/// of which makes the same calls with the same numbers; else this process has all of them. Throws InputError
/// when the library was not built or cannot be loaded.
std::unique_ptr<ConjugateGradients> make_conjugate_gradients(bool of_all_ranks = false);

/// Whether `make_conjugate_gradients` gives one.
bool has_conjugate_gradients();

} // namespace rubato::linalg
