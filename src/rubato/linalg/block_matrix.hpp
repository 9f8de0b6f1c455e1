// SPDX-License-Identifier: LGPL-3.0-or-later
/// A symmetric matrix of dense 2×2 or 3×3 blocks for products that are limited by memory alone: what explicit
/// steps do all day. Of each pair of blocks a_ij = a_jiᵀ one is stored and used twice, and one index serves a
/// whole block, so a product reads little more than half of what a scalar compressed row holds.
#pragma once

#include "rubato/core/threads.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::linalg {

/// What a product is compiled for: `plain` is every processor of the architecture, `fused` one that
/// multiplies and adds in one instruction (x86-64 with AVX2 and FMA; elsewhere the same as `plain`). The two
/// differ by rounding.
enum class Instructions : std::uint8_t { plain, fused };

/// The fastest that this processor has.
Instructions best_instructions();

class SymmetricBlockMatrix {
public:
  /// `matrix`: symmetric, of size · block_size rows, entries in whole blocks (as domain::BlockPattern makes
  /// them; missing entries of a block count as 0). Only blocks on and above the diagonal are read. Throws
  /// std::invalid_argument when block_size is neither 2 nor 3 or the rows are no whole number of blocks.
  SymmetricBlockMatrix(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& matrix, int block_size,
                       const Threads& threads = {});

  /// y = A x, x and y with rows() entries and not the same. Allocates nothing with one thread. Products with
  /// other numbers of threads differ by rounding, those with the same number do not.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const { multiply(x, y, best_instructions()); }
  /// Likewise with instructions that this processor must have.
  void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y, Instructions instructions) const;

  Eigen::Index rows() const { return static_cast<Eigen::Index>(diagonal_count()) * block_size_; }
  /// Bytes that one product reads of the matrix.
  std::size_t bytes() const;

private:
  std::size_t diagonal_count() const { return start_.size() - 1; }
  void deal_out_rows();
  void add_from_before(std::span<const std::vector<double>> behind, std::size_t part,
                       Eigen::VectorXd& y) const;

  int block_size_;
  Threads threads_;
  std::vector<std::int64_t>
      part_starts_; ///< block rows at which parts for threads begin; one more at the end
  std::vector<std::int64_t>
      reach_; ///< of parts: the first block row that no row of it, nor before, has blocks in
  std::vector<std::int64_t> start_; ///< of block rows: first block right of the diagonal; one more at the end
  std::vector<std::int32_t> column_; ///< of blocks right of the diagonal
  std::vector<double> diagonal_;     ///< blocks, column after column
  std::vector<double> upper_;        ///< likewise, in the order of `column_`
};

} // namespace rubato::linalg
