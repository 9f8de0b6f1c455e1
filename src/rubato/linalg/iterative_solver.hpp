// SPDX-License-Identifier: LGPL-3.0-or-later
/// Solves with a symmetric positive definite matrix without a factor of it: conjugate gradients.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/linalg/surface_solver.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rubato::linalg {

/// What an iterative solver knows of the unknowns beside their matrix.
struct NodalUnknowns {
  int components = 1;    ///< of a node
  std::vector<int> dofs; ///< of every unknown, ascending: node · components + component
  Eigen::MatrixXd rigid; ///< rigid motions of the whole: a row an unknown, a column a motion
};

struct IterativeSettings {
  /// Of a solve: |b − A x| of |b|. Near rounding, so that what follows from solutions hardly tells them from
  /// those by a factor.
  double tolerance = 1e-12;
  int most_iterations = 500;
  /// Bodies of up to so many unknowns have a factor of their own: that is less work.
  Eigen::Index largest_factored = 600;
  /// Those that work on the others, each with its part of the rows. They make the same calls, each with its
  /// part of the matrix (ranked_matrix.hpp); for the set-up each has the whole for a while.
  Ranks ranks = {};
};

/// Each body is solved for itself. Unknowns of a node stand together, and those that a node lacks, as where a
/// support holds it along one axis, are unit rows: multigrid then coarsens nodes, not unknowns.
///
/// "Half way" is the solution itself: `forward` and `load_surface` cost a solve, `backward` nothing. A column
/// of the compliance costs a solve of its body. One thread computes.
class IterativeSolver final : public SurfaceSolver {
public:
  /// Null when the matrix is not positive definite or has a value that is not finite. A diagonal tells, or a
  /// first solve with a right side of all frequencies; a later solve that meets such a direction throws
  /// NotSolved. `tell` hears what the solver is expected to need [bytes] before anything is set up. Throws
  /// InputError where the library of conjugate gradients is missing, NotSolved where that first solve does
  /// not converge, std::invalid_argument when sizes do not fit.
  static std::unique_ptr<IterativeSolver> of(
      const SparseMatrix& matrix, std::span<const int> surface, NodalUnknowns unknowns,
      const std::function<void(std::size_t)>& tell = [](std::size_t) {},
      const IterativeSettings& settings = {});
  IterativeSolver(const IterativeSolver&) = delete;
  IterativeSolver& operator=(const IterativeSolver&) = delete;
  ~IterativeSolver() override;

  /// Throws NotSolved as `of` does.
  bool refactor(const SparseMatrix& matrix) override;
  bool has_values() const override { return has_values_; }
  std::size_t renewals(std::size_t body) const override;

  // All that solves throws NotSolved when it does not converge.
  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const override;
  Eigen::VectorXd forward(const Eigen::VectorXd& right_side) const override { return solve(right_side); }
  Eigen::VectorXd surface_of(const Eigen::VectorXd& half_way) const override { return half_way(surface_); }
  void load_surface(const Eigen::VectorXd& force, Eigen::VectorXd& half_way) const override;
  Eigen::VectorXd backward(const Eigen::VectorXd& half_way) const override { return half_way; }

  const std::vector<int>& surface() const override { return surface_; }
  const std::vector<int>& body_starts() const override { return body_starts_; }
  const SurfaceInFactor* surface_within(std::size_t) const override { return nullptr; }
  Eigen::MatrixXd compliance(std::size_t body) const override;
  Eigen::MatrixXd compliance(std::size_t body, Eigen::Index first, Eigen::Index count) const override;
  Eigen::VectorXd moved_by(std::size_t body, const Eigen::VectorXd& force) const override;
  bool has_dear_columns() const override { return true; }

  const Threads& threads() const override { return threads_; }
  std::size_t factor_bytes() const override { return bytes_; }
  /// As much as so many solves by `factor_bytes` as the preconditioner costs.
  double factor_flops() const override;

  /// Solves and their iterations so far, of all bodies.
  struct Count {
    std::size_t solves = 0;
    std::size_t iterations = 0;
  };
  const Count& count() const { return count_; }

private:
  struct Body;
  IterativeSolver(const SparseMatrix& matrix, std::span<const int> surface, NodalUnknowns unknowns,
                  const IterativeSettings& settings);
  void number_surface(std::span<const int> surface, const std::vector<int>& body_of);
  bool set_up_all(const SparseMatrix& whole);
  bool set_up(const SparseMatrix& matrix, std::size_t body);
  Eigen::VectorXd solved(std::size_t body, const Eigen::VectorXd& right_side, double tolerance) const;
  Eigen::VectorXd on_surface(std::size_t body, const Eigen::VectorXd& solution) const;
  void must_have_values() const;

  NodalUnknowns unknowns_;
  IterativeSettings settings_;
  Threads threads_;
  std::vector<Body> bodies_;
  std::vector<int> place_; ///< of every unknown: its row in its body
  std::vector<int> surface_;
  std::vector<int> body_starts_;
  std::uint64_t pattern_ = 0;
  std::size_t bytes_ = 0;
  bool has_values_ = false;
  mutable Count count_;
};

/// What conjugate gradients need for a matrix [bytes], all told: its rows a second time, those of the coarser
/// grids, and what building them takes for a while.
std::size_t iterative_bytes(const SparseMatrix& matrix);

} // namespace rubato::linalg
