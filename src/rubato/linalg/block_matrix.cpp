// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/block_matrix.hpp"

#include "rubato/linalg/sparse_matrix.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>

namespace rubato::linalg {
namespace {

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

/// How far ahead of the product blocks are asked for, in numbers: a few kilobytes get ahead of what the
/// processor fetches by itself.
constexpr std::int64_t look_ahead = 512;

/// The arrays of a symmetric block matrix.
struct Blocks {
  std::span<const std::int64_t> start;
  const std::int32_t* column;
  const double* diagonal;
  const double* upper;
};

/// Block rows that one thread multiplies. What they add to rows behind them goes to `behind`, in the place of
/// y's entries from row `last` on; null: there are none.
struct Rows {
  std::int64_t first = 0;
  std::int64_t last = 0;
  double* behind = nullptr;
};

/// y_i += A_ij x_j and y_j += A_ijᵀ x_i over the stored blocks, row after row. In numbers, not in expressions
/// of small matrices: what one row has put into y the next rows soon read again, and a processor waits when
/// it reads in one piece what it is still writing in two.
template <int Size, bool HasBehind>
[[gnu::always_inline]] inline void multiply_rows(const Blocks& blocks, const Rows& rows, const double* x,
                                                 double* y) {
  const auto [start, column, diagonal, upper] = blocks;
  const auto [first, last, behind] = rows;
  constexpr int area = Size * Size;
  std::fill(y + first * Size, y + last * Size, 0.0);
  for (std::int64_t i = first; i < last; ++i) {
    const double* own = diagonal + i * area;
    double here[Size];
    double sum[Size] = {};
    for (int r = 0; r < Size; ++r)
      here[r] = x[i * Size + r];
    for (int c = 0; c < Size; ++c)
      for (int r = 0; r < Size; ++r)
        sum[r] += own[c * Size + r] * here[c];
    for (auto k = start[at(i)]; k < start[at(i) + 1]; ++k) {
      const double* block = upper + k * area;
      const double* there = x + std::int64_t{column[k]} * Size;
      double* result = y + std::int64_t{column[k]} * Size;
      if constexpr (HasBehind)
        if (column[k] >= last)
          result = behind + (column[k] - last) * Size;
      double part[Size];
      __builtin_prefetch(block + look_ahead);
      for (int c = 0; c < Size; ++c)
        part[c] = result[c];
      for (int c = 0; c < Size; ++c)
        for (int r = 0; r < Size; ++r) {
          sum[r] += block[c * Size + r] * there[c];
          part[c] += block[c * Size + r] * here[r];
        }
      for (int c = 0; c < Size; ++c)
        result[c] = part[c];
    }
    for (int r = 0; r < Size; ++r)
      y[i * Size + r] += sum[r];
  }
}

template <int Size>
[[gnu::always_inline]] inline void multiply_some(const Blocks& blocks, const Rows& rows, const double* x,
                                                 double* y) {
  if (rows.behind == nullptr)
    multiply_rows<Size, false>(blocks, rows, x, y);
  else
    multiply_rows<Size, true>(blocks, rows, x, y);
}

template <int Size> void multiply_plain(const Blocks& blocks, const Rows& rows, const double* x, double* y) {
  multiply_some<Size>(blocks, rows, x, y);
}

#ifdef __x86_64__
template <int Size>
[[gnu::target("avx2,fma")]] void multiply_fused(const Blocks& blocks, const Rows& rows, const double* x,
                                                double* y) {
  multiply_some<Size>(blocks, rows, x, y);
}
#else
template <int Size> void multiply_fused(const Blocks& blocks, const Rows& rows, const double* x, double* y) {
  multiply_some<Size>(blocks, rows, x, y);
}
#endif

bool processor_fuses() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}

} // namespace

Instructions best_instructions() {
  static const auto best = processor_fuses() ? Instructions::fused : Instructions::plain;
  return best;
}

SymmetricBlockMatrix::SymmetricBlockMatrix(const SparseMatrix& matrix, int block_size, const Threads& threads)
    : block_size_(block_size), threads_(threads) {
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
  deal_out_rows();
}

/// By their entries: a product takes as long as it reads.
void SymmetricBlockMatrix::deal_out_rows() {
  constexpr std::size_t smallest = 100'000; // blocks
  const auto rows = static_cast<std::int64_t>(diagonal_count());
  const auto parts = threads_.parts_of(column_.size(), smallest);
  const auto work_before = [&](std::int64_t row) { return start_[at(row)] + row; };
  std::int64_t row = 0, reach = 0;
  for (int part = 0; part < parts; ++part) {
    part_starts_.push_back(row);
    const auto end = work_before(rows) * (part + 1) / parts;
    for (; row < rows && (work_before(row + 1) <= end || part + 1 == parts); ++row)
      if (start_[at(row) + 1] > start_[at(row)])
        reach = std::max(reach, std::int64_t{column_[at(start_[at(row) + 1]) - 1]} + 1);
    reach_.push_back(std::max(reach, row));
  }
  part_starts_.push_back(rows);
}

void SymmetricBlockMatrix::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y,
                                    Instructions instructions) const {
  const Blocks blocks{start_, column_.data(), diagonal_.data(), upper_.data()};
  const bool fused = instructions == Instructions::fused;
  const auto work = block_size_ == 2 ? (fused ? multiply_fused<2> : multiply_plain<2>)
                                     : (fused ? multiply_fused<3> : multiply_plain<3>);
  const auto parts = static_cast<int>(reach_.size());
  if (parts == 1)
    return work(blocks, {0, static_cast<std::int64_t>(diagonal_count()), nullptr}, x.data(), y.data());
  std::vector<std::vector<double>> behind(reach_.size());
  threads_.each(parts, [&](int part) {
    const auto p = at(part);
    behind[p].assign(at((reach_[p] - part_starts_[p + 1]) * block_size_), 0.0);
    work(blocks, {part_starts_[p], part_starts_[p + 1], behind[p].data()}, x.data(), y.data());
  });
  threads_.each(parts, [&](int part) { add_from_before(behind, at(part), y); });
}

/// Adds to the rows of a part what those before it have for them.
void SymmetricBlockMatrix::add_from_before(std::span<const std::vector<double>> behind, std::size_t part,
                                           Eigen::VectorXd& y) const {
  const auto first = part_starts_[part], last = part_starts_[part + 1];
  for (std::size_t before = 0; before < part; ++before) {
    const auto start = part_starts_[before + 1];
    const auto end = std::min(last, reach_[before]);
    for (auto i = first * block_size_; i < end * block_size_; ++i)
      y[i] += behind[before][at(i - start * block_size_)];
  }
}

std::size_t SymmetricBlockMatrix::bytes() const {
  return (diagonal_.size() + upper_.size()) * sizeof(double) + column_.size() * sizeof(std::int32_t) +
         start_.size() * sizeof(std::int64_t);
}

} // namespace rubato::linalg
