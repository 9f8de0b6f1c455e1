// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/order_of_elimination.hpp"

#include <gtest/gtest.h>

#include "support/thread_ranks.hpp"
#include "unit/linalg/elastic_block.hpp"
#include <algorithm>
#include <mutex>
#include <numeric>
#include <vector>

namespace rubato::linalg::order_of_elimination_test {
namespace {

/// Columns that follow one another, of about as many to each rank.
SparseMatrix columns_of(const SparseMatrix& whole, const Ranks& ranks) {
  SparseMatrix part = whole;
  part.prune([&](int, int column, double) { return column * ranks.count() / whole.cols() == ranks.index(); });
  return part;
}

std::vector<int> ordered(const SparseMatrix& whole, const std::vector<int>& surface, int count) {
  std::vector<int> order;
  std::mutex turn;
  test::as_ranks(count, [&](const Ranks& ranks) {
    const auto found = order_of_elimination(columns_of(whole, ranks), surface, ranks);
    EXPECT_EQ(found.empty(), !ranks.is_first());
    const std::lock_guard lock(turn);
    if (ranks.is_first())
      order = found;
  });
  return order;
}

/// Numbers of the factor of a matrix with such a pattern, by elimination.
std::size_t fill(const SparseMatrix& matrix, const std::vector<int>& order) {
  const auto size = order.size();
  std::vector<std::vector<char>> entries(size, std::vector<char>(size, 0));
  for (int column = 0; column < matrix.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      entries[static_cast<std::size_t>(order[static_cast<std::size_t>(column)])]
             [static_cast<std::size_t>(order[static_cast<std::size_t>(entry.row())])] = 1;
  std::size_t numbers = 0;
  for (std::size_t pivot = 0; pivot < size; ++pivot) {
    std::vector<std::size_t> below;
    for (std::size_t row = pivot + 1; row < size; ++row)
      if (entries[pivot][row] != 0)
        below.push_back(row);
    numbers += below.size() + 1;
    for (const auto row : below)
      for (const auto column : below)
        entries[row][column] = 1;
  }
  return numbers;
}

TEST(OrderOfElimination, HasEachPlaceOnceAndTheSurfaceLast) {
  const auto matrix = test::elastic_block(6, 3, 2);
  const std::vector<int> surface{17, 3, 40};
  const auto order = ordered(matrix, surface, 3);
  auto places = order;
  std::ranges::sort(places);
  std::vector<int> all(static_cast<std::size_t>(matrix.cols()));
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(places, all);
  const int first = static_cast<int>(matrix.cols()) - 3;
  EXPECT_EQ(order[17], first);
  EXPECT_EQ(order[3], first + 1);
  EXPECT_EQ(order[40], first + 2);
}

TEST(OrderOfElimination, SavesFill) {
  const auto matrix = test::elastic_block(6, 4, 4);
  std::vector<int> as_numbered(static_cast<std::size_t>(matrix.cols()));
  std::iota(as_numbered.begin(), as_numbered.end(), 0);
  EXPECT_LT(fill(matrix, ordered(matrix, {}, 2)), fill(matrix, as_numbered));
}

TEST(OrderOfElimination, OfASurfaceAloneIsThatOfTheSurface) {
  SparseMatrix matrix(2, 2);
  matrix.setIdentity();
  EXPECT_EQ(ordered(matrix, {1, 0}, 2), (std::vector<int>{1, 0}));
}

} // namespace
} // namespace rubato::linalg::order_of_elimination_test
