// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/block_matrix.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>

namespace rubato::linalg {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// The block columns j ≥ i that row i of blocks has entries in, ascending.
std::vector<std::vector<std::int32_t>> upper_pattern(const SparseMatrix& matrix, int size) {
  std::vector<std::vector<std::int32_t>> pattern(at(matrix.rows() / size));
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      auto& row = pattern[at(entry.row() / size)];
      const std::int32_t block = column / size;
      if (block > entry.row() / size && (row.empty() || row.back() != block))
        row.push_back(block);
    }
  return pattern;
}

/// How far ahead of the product blocks are asked for, in numbers: a kilobyte or more gets ahead of what the
/// processor fetches by itself.
constexpr std::int64_t look_ahead = 1024;

/// y_i += A_ij x_j and y_j += A_ijᵀ x_i over the stored blocks, row after row. The size of a block is known
/// to the compiler, so that a block is a few registers.
template <int Size>
void multiply_blocks(std::span<const std::int64_t> start, const std::int32_t* column, const double* diagonal,
                     const double* upper, const double* x, double* y) {
  using Block = Eigen::Map<const Eigen::Matrix<double, Size, Size>>;
  using Part = Eigen::Matrix<double, Size, 1>;
  const auto rows = static_cast<std::int64_t>(start.size()) - 1;
  std::fill_n(y, rows * Size, 0.0);
  for (std::int64_t i = 0; i < rows; ++i) {
    const Part here = Eigen::Map<const Part>(x + i * Size);
    Part sum = Block(diagonal + i * Size * Size) * here;
    for (auto k = start[at(i)]; k < start[at(i) + 1]; ++k) {
      const Block block(upper + k * Size * Size);
      __builtin_prefetch(upper + k * Size * Size + look_ahead);
      const auto other = std::int64_t{column[k]} * Size;
      sum += block * Eigen::Map<const Part>(x + other);
      Eigen::Map<Part>(y + other) += block.transpose() * here;
    }
    Eigen::Map<Part>(y + i * Size) += sum;
  }
}

} // namespace

SymmetricBlockMatrix::SymmetricBlockMatrix(const SparseMatrix& matrix, int block_size)
    : block_size_(block_size) {
  if (block_size != 2 && block_size != 3)
    throw std::invalid_argument("a symmetric block matrix has blocks of size 2 or 3");
  if (matrix.rows() != matrix.cols() || matrix.rows() % block_size != 0)
    throw std::invalid_argument("the matrix is no square of whole blocks");
  const auto pattern = upper_pattern(matrix, block_size);
  start_.push_back(0);
  for (const auto& row : pattern) {
    column_.insert(column_.end(), row.begin(), row.end());
    start_.push_back(static_cast<std::int64_t>(column_.size()));
  }
  const auto area = at(block_size) * at(block_size);
  diagonal_.assign(pattern.size() * area, 0.0);
  upper_.assign(column_.size() * area, 0.0);
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
      const auto i = entry.row() / block_size;
      const auto j = column / block_size;
      const auto inside = at(column % block_size) * at(block_size) + at(entry.row() % block_size);
      if (i == j)
        diagonal_[at(i) * area + inside] = entry.value();
      if (i >= j)
        continue;
      const auto first = column_.begin() + start_[at(i)];
      const auto place = std::lower_bound(first, column_.begin() + start_[at(i) + 1], j) - column_.begin();
      upper_[at(place) * area + inside] = entry.value();
    }
}

void SymmetricBlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
  if (block_size_ == 2)
    multiply_blocks<2>(start_, column_.data(), diagonal_.data(), upper_.data(), x.data(), y.data());
  else
    multiply_blocks<3>(start_, column_.data(), diagonal_.data(), upper_.data(), x.data(), y.data());
}

std::size_t SymmetricBlockMatrix::bytes() const {
  return (diagonal_.size() + upper_.size()) * sizeof(double) + column_.size() * sizeof(std::int32_t) +
         start_.size() * sizeof(std::int64_t);
}

} // namespace rubato::linalg
