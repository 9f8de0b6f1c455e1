// SPDX-License-Identifier: LGPL-3.0-or-later
/// A Cholesky factor that shows what happens at chosen unknowns, the surface, half way through a solve.
#pragma once

#include "rubato/core/threads.hpp"
#include "rubato/linalg/surface_solver.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rubato::linalg {

struct LowerTriangle;

/// Sizes of surfaces: how many unknowns a body has on its own.
struct SurfaceLimits {
  /// Up to this the surface is eliminated last, whatever that costs.
  Eigen::Index last = std::numeric_limits<Eigen::Index>::max();
  /// Up to this the compliance of a surface that is eliminated within its body is formed whole. That pays
  /// where the values of the matrix stay for many steps.
  Eigen::Index whole_within = 0;
};

/// The factor of a symmetric positive definite matrix whose surface is eliminated last:
///   A = [A_ii A_is; A_si A_ss],  L = [L_ii 0; L_si L_ss],  L_ss L_ssᵀ = A_ss − A_si A_ii⁻¹ A_is = S⁻¹,
/// S = B A⁻¹ Bᵀ the compliance of the surface, B picking its unknowns. The solution of A x = b is known on
/// the surface once L y = b is solved: x_s = L_ss⁻ᵀ y_s. A force added there then changes y_s alone. Bodies
/// that A does not couple are factored each for itself.
///
/// L_ss is dense. Of a thin or slender body, whose surface has many of its unknowns, it has more entries than
/// the whole factor in an order of its own, or takes more arithmetic: there the surface may be eliminated
/// within the body (SurfaceInFactor).
///
/// Surface unknowns are counted body after body, in their order of elimination: their positions.
///
/// Threads factor and solve bodies side by side. A body that is most of the whole is factored by all threads
/// of OpenBLAS instead; its factor then depends on their number by rounding.
///
/// Bodies, positions and the order of elimination follow from the pattern of the matrix alone. They serve
/// every matrix of that pattern: `refactor`.
class SplitFactor final : public SurfaceSolver {
public:
  /// Nothing comes back when the matrix is not positive definite to working precision or has a value that is
  /// not finite. A surface that is eliminated last keeps the order of `surface`. `tell` hears what the factor
  /// and its compliance need [bytes] as soon as their entries are counted, before the first value is
  /// computed. Surfaces of more than `limits.last` unknowns are eliminated within their body where its whole
  /// factor is then smaller than L_ss alone, or takes fewer multiplications. Throws TooLargeForMemory when
  /// they would not fit into `memory` [bytes], std::invalid_argument when the matrix is not square.
  static std::optional<SplitFactor> of(
      const SparseMatrix& matrix, std::span<const int> surface, std::size_t memory,
      const std::function<void(std::size_t)>& tell = [](std::size_t) {}, SurfaceLimits limits = {},
      const Threads& threads = {});
  /// The same without values, which `refactor` gives: only the pattern of the matrix counts, and it need not
  /// be positive definite. Throws as `of` does.
  static SplitFactor analysed(
      const SparseMatrix& matrix, std::span<const int> surface, std::size_t memory,
      const std::function<void(std::size_t)>& tell = [](std::size_t) {}, SurfaceLimits limits = {},
      const Threads& threads = {});
  SplitFactor(SplitFactor&&) noexcept;
  SplitFactor& operator=(SplitFactor&&) noexcept;
  ~SplitFactor() override;

  /// The factor of another matrix of the same pattern, in the same memory: bit for bit the one that `of`
  /// makes of it. Bodies whose values are the ones they were factored with keep theirs, known by a checksum
  /// of 64 bits. False when the matrix is not positive definite to working precision or has a value that is
  /// not finite: there are no values then, and until a later call succeeds nothing can be solved. Throws
  /// std::invalid_argument when the pattern (entries that are stored, zeros among them) is another one.
  bool refactor(const SparseMatrix& matrix) override;
  bool has_values() const override { return has_values_; }
  std::size_t renewals(std::size_t body) const override;

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const override;

  /// y of L y = b, body after body in the order of elimination.
  Eigen::VectorXd forward(const Eigen::VectorXd& right_side) const override;
  /// x_s = L_ss⁻ᵀ y_s, one a position.
  Eigen::VectorXd surface_of(const Eigen::VectorXd& half_way) const override;
  /// y_s += L_ss⁻¹ f_s: what `forward` would have given with these forces on the surface.
  void load_surface(const Eigen::VectorXd& force, Eigen::VectorXd& half_way) const override;
  /// x of Lᵀ x = y.
  Eigen::VectorXd backward(const Eigen::VectorXd& half_way) const override;

  const std::vector<int>& surface() const override { return surface_; }
  const std::vector<int>& body_starts() const override { return body_starts_; }
  const SurfaceInFactor* surface_within(std::size_t body) const override;
  /// S of a body whose surface is eliminated last, or within it and S is formed whole.
  Eigen::MatrixXd compliance(std::size_t body) const override;
  /// The same, of a surface that is eliminated last, for unit forces at `count` of its positions from `first`
  /// on (counted from its first): one column each. All columns take three times as long by this.
  Eigen::MatrixXd compliance(std::size_t body, Eigen::Index first, Eigen::Index count) const override;

  Eigen::VectorXd moved_by(std::size_t body, const Eigen::VectorXd& force) const override;
  bool has_dear_columns() const override { return false; }

  const Threads& threads() const override { return threads_; }

  /// Memory the factor holds.
  std::size_t factor_bytes() const override;
  /// Entries of L on and below the diagonal. A solve multiplies by each twice.
  std::size_t factor_nonzeros() const;
  /// Multiplications and additions that the values of L take: Σ c², c the entries of a column. That is m³/3
  /// of a dense surface of m unknowns; its compliance takes 2 m³/3 more. Without the zeros that are stored to
  /// make columns of L alike, as with `factor_nonzeros`.
  double factor_flops() const override;

private:
  struct Body;
  SplitFactor(const SparseMatrix& matrix, std::span<const int> surface, const Threads& threads);
  std::vector<LowerTriangle> triangles_of(const SparseMatrix& matrix) const;
  void analyse(std::vector<LowerTriangle>& triangles, std::size_t memory,
               const std::function<void(std::size_t)>& tell, SurfaceLimits limits);
  bool factorise(const std::function<LowerTriangle(std::size_t)>& triangle_of);
  bool factorise_by_blas(const std::function<LowerTriangle(std::size_t)>& triangle_of);
  bool pays_side_by_side() const;
  template <class Work> void each_body(const Work& work) const;
  Eigen::Index first_position(const Body& body) const;
  void must_have_values() const;

  Threads threads_;
  std::vector<Body> bodies_;
  std::vector<int> surface_;
  std::vector<int> body_starts_;
  Eigen::Index size_ = 0;
  std::uint64_t pattern_ = 0;
  bool has_values_ = false;
};

} // namespace rubato::linalg
