// SPDX-License-Identifier: LGPL-3.0-or-later
/// What condensed steps ask of whatever solves with their effective matrix.
#pragma once

#include "rubato/core/threads.hpp"
#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::linalg {

class SurfaceInFactor;

/// Solves A x = b with a symmetric positive definite matrix A and tells what happens at chosen unknowns, the
/// surface, half way through a solve: a vector y made by `forward`, which forces on the surface change at
/// little cost. S = B A⁻¹ Bᵀ is the compliance of the surface, B picking its unknowns.
///
/// Bodies are what A couples. Surface unknowns are counted body after body: their positions.
class SurfaceSolver {
public:
  SurfaceSolver() = default;
  virtual ~SurfaceSolver() = default;

  /// Solves with another matrix of the same pattern from here on. False when it is not positive definite to
  /// working precision or has a value that is not finite: there are no values then, and until a later call
  /// succeeds nothing can be solved. Throws std::invalid_argument when the pattern (entries that are stored,
  /// zeros among them) is another one.
  virtual bool refactor(const SparseMatrix& matrix) = 0;
  /// Whether there are values. All that solves or gives the compliance throws std::logic_error without.
  virtual bool has_values() const = 0;
  /// How often this body's values were computed anew or lost: what was made of them holds as long as this
  /// number stays.
  virtual std::size_t renewals(std::size_t body) const = 0;

  /// x = A⁻¹ b
  virtual Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const = 0;
  /// y of b.
  virtual Eigen::VectorXd forward(const Eigen::VectorXd& right_side) const = 0;
  /// x on the surface, one a position.
  virtual Eigen::VectorXd surface_of(const Eigen::VectorXd& half_way) const = 0;
  /// Makes of y what `forward` would have given with these forces, one a position, on the surface.
  virtual void load_surface(const Eigen::VectorXd& force, Eigen::VectorXd& half_way) const = 0;
  /// x of y.
  virtual Eigen::VectorXd backward(const Eigen::VectorXd& half_way) const = 0;

  /// The unknown of every position.
  virtual const std::vector<int>& surface() const = 0;
  /// Positions at which one body's end and the next one's begin, 0 first.
  virtual const std::vector<int>& body_starts() const = 0;
  /// Of a body whose surface is eliminated within it; else nothing.
  virtual const SurfaceInFactor* surface_within(std::size_t body) const = 0;
  /// S of a body whose surface is not eliminated within it, or where S is formed whole
  /// (SurfaceInFactor::is_formed_whole).
  virtual Eigen::MatrixXd compliance(std::size_t body) const = 0;
  /// The same, of a surface that is not eliminated within its body, for unit forces at `count` of its
  /// positions from `first` on (counted from its first): one column each.
  virtual Eigen::MatrixXd compliance(std::size_t body, Eigen::Index first, Eigen::Index count) const = 0;
  /// S f of forces that are not zero on one body only, f and the answer with its positions.
  virtual Eigen::VectorXd moved_by(std::size_t body, const Eigen::VectorXd& force) const = 0;
  /// Whether each column of the compliance costs a whole solve, and more where it is computed with others.
  virtual bool has_dear_columns() const = 0;

  virtual const Threads& threads() const = 0;

  /// Memory that it holds for solves.
  virtual std::size_t factor_bytes() const = 0;
  /// Multiplications and additions that values for another matrix take.
  virtual double factor_flops() const = 0;

protected:
  SurfaceSolver(const SurfaceSolver&) = default;
  SurfaceSolver(SurfaceSolver&&) = default;
  SurfaceSolver& operator=(const SurfaceSolver&) = default;
  SurfaceSolver& operator=(SurfaceSolver&&) = default;
};

/// An iterative solution came to no end, or met a direction in which the matrix is not positive definite.
class NotSolved : public std::runtime_error {
public:
  NotSolved(const std::string& text, double residual_left, double residual_allowed)
      : std::runtime_error(text), left(residual_left), allowed(residual_allowed) {}
  double left = 0; ///< of the right side's norm
  double allowed = 0;
};

/// Surface unknowns body after body, each in the order that was given.
struct SurfaceOfBodies {
  std::vector<int> unknowns;
  std::vector<int> starts = {0}; ///< where one body's end and the next one's begin
};
SurfaceOfBodies surface_of_bodies(std::span<const int> surface, const std::vector<int>& body_of, int bodies);

/// Of every unknown the number of its body: unknowns belong together when the matrix couples them.
std::vector<int> bodies_of(const SparseMatrix& matrix, int& count);

} // namespace rubato::linalg
