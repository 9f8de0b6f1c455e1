// SPDX-License-Identifier: LGPL-3.0-or-later
/// A factor that all ranks hold together, for condensed steps.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/linalg/factor_of_ranks.hpp"
#include "rubato/linalg/surface_solver.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rubato::linalg {

/// All ranks make the same calls and get the same answers. Each gives its part of the matrix
/// (ranked_matrix.hpp); the compliance of the surface, one dense matrix a body, all have.
///
/// "Half way" is the right side itself with what it comes to on the surface: b, then b_s − A_si A_ii⁻¹ b_i
/// with the forces that were added there, then the number of the solve whose first half the factor remembers.
/// The second half of another one repeats its first.
class RankedFactor final : public SurfaceSolver {
public:
  /// Null when the matrix is not positive definite to working precision or has a value that is not finite.
  /// `tell` hears what this rank needs [bytes] before the first value is computed. Throws InputError where
  /// the library is missing, std::invalid_argument when the matrix is not square.
  /// `matrix`: the part of this rank, of which the lower triangle counts.
  static std::unique_ptr<RankedFactor> of(
      const SparseMatrix& matrix, std::span<const int> surface, Ranks ranks, const Threads& threads,
      const std::function<void(std::size_t)>& tell = [](std::size_t) {});

  bool refactor(const SparseMatrix& matrix) override;
  bool has_values() const override { return has_values_; }
  std::size_t renewals(std::size_t) const override { return renewals_; }

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const override;
  Eigen::VectorXd forward(const Eigen::VectorXd& right_side) const override;
  Eigen::VectorXd surface_of(const Eigen::VectorXd& half_way) const override;
  void load_surface(const Eigen::VectorXd& force, Eigen::VectorXd& half_way) const override;
  Eigen::VectorXd backward(const Eigen::VectorXd& half_way) const override;

  const std::vector<int>& surface() const override { return surface_.unknowns; }
  const std::vector<int>& body_starts() const override { return surface_.starts; }
  const SurfaceInFactor* surface_within(std::size_t) const override { return nullptr; }
  Eigen::MatrixXd compliance(std::size_t body) const override;
  Eigen::MatrixXd compliance(std::size_t body, Eigen::Index first, Eigen::Index count) const override;
  Eigen::VectorXd moved_by(std::size_t body, const Eigen::VectorXd& force) const override;
  bool has_dear_columns() const override { return false; }

  const Threads& threads() const override { return threads_; }
  /// Of all ranks.
  std::size_t factor_bytes() const override { return bytes_; }
  double factor_flops() const override { return flops_; }

private:
  RankedFactor(const SparseMatrix& matrix, std::span<const int> surface, Ranks ranks, const Threads& threads);
  void analyse(const SparseMatrix& matrix, const std::function<void(std::size_t)>& tell);
  bool share_compliance(const Eigen::MatrixXd& complement);
  Eigen::VectorXd condensed(const Eigen::VectorXd& right_side) const;
  Eigen::Index surface_size() const { return static_cast<Eigen::Index>(surface_.unknowns.size()); }
  void must_have_values() const;

  Ranks ranks_;
  Threads threads_;
  Eigen::Index size_ = 0;
  SurfaceOfBodies surface_;
  std::uint64_t pattern_ = 0;
  std::uint64_t values_ = 0; ///< their checksum
  std::unique_ptr<FactorOfRanks> factor_;
  std::vector<Eigen::MatrixXd> compliances_; ///< one a body
  std::size_t renewals_ = 0;
  std::size_t bytes_ = 0;
  double flops_ = 0;
  bool has_values_ = false;
  mutable std::int64_t solves_ = 0;     ///< first halves so far
  mutable std::int64_t remembered_ = 0; ///< the one whose second half can follow
};

} // namespace rubato::linalg
