// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/linalg/surface_solver.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "support/thread_ranks.hpp"
#include "unit/linalg/elastic_block.hpp"
#include "unit/linalg/matrices_beside.hpp"
#include "unit/linalg/random_vector.hpp"
#include <algorithm>
#include <cmath>
#include <functional>

namespace rubato::linalg::ranked_matrix_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The part of an entry that each rank has; together they have all of it.
using PartOf = std::function<double(int row, int column, const Ranks& ranks)>;

SparseMatrix part_of(const SparseMatrix& whole, const PartOf& part, const Ranks& ranks) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int column = 0; column < whole.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(whole, column); entry; ++entry)
      if (const double own = part(static_cast<int>(entry.row()), column, ranks); own != 0)
        entries.emplace_back(static_cast<int>(entry.row()), column, own * entry.value());
  SparseMatrix matrix(whole.rows(), whole.cols());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// Entries go round among the ranks, some are shared by all, the last rank has none of its own.
double dealt_out(int row, int column, const Ranks& ranks) {
  const int sum = row + column, others = ranks.count() - 1;
  if (sum % 5 == 0)
    return 1.0 / ranks.count();
  return sum % others == ranks.index() ? 1 : 0;
}

class SumOfParts : public testing::TestWithParam<int> {
protected:
  void each_rank(const std::function<void(const SparseMatrix&, const Ranks&)>& work) const {
    test::as_ranks(GetParam(), [&](const Ranks& ranks) { work(part_of(whole_, dealt_out, ranks), ranks); });
  }

  SparseMatrix whole_ = test::beside(test::elastic_block(3, 2, 2), test::elastic_block(2, 2, 1));
};

TEST_P(SumOfParts, IsTheWhole) {
  each_rank([&](const SparseMatrix& part, const Ranks& ranks) {
    const auto sum = whole_of(part, ranks);
    EXPECT_EQ(sum.nonZeros(), whole_.nonZeros());
    EXPECT_LE((MatrixXd(sum) - MatrixXd(whole_)).norm(), 1e-15 * whole_.norm());
  });
}

TEST_P(SumOfParts, MultipliesAsTheWhole) {
  const auto x = test::random_vector(whole_.cols(), 1);
  const VectorXd product = whole_ * x, diagonal = whole_.diagonal();
  each_rank([&](const SparseMatrix& part, const Ranks& ranks) {
    EXPECT_LE((product_of(part, x, ranks) - product).norm(), 1e-14 * product.norm());
    EXPECT_LE((diagonal_of(part, ranks) - diagonal).norm(), 1e-15 * diagonal.norm());
  });
}

TEST_P(SumOfParts, HasTheBodiesOfTheWhole) {
  int expected_count = 0;
  const auto expected = bodies_of(whole_, expected_count);
  each_rank([&](const SparseMatrix& part, const Ranks& ranks) {
    int count = 0;
    EXPECT_EQ(bodies_of(part, ranks, count), expected);
    EXPECT_EQ(count, expected_count);
  });
}

INSTANTIATE_TEST_SUITE_P(Ranks, SumOfParts, testing::Values(2, 3, 5));

/// Links of one chain that no rank has two neighbouring ones of.
TEST(BodiesOfParts, AreJoinedAcrossRanks) {
  constexpr int size = 9;
  test::as_ranks(3, [&](const Ranks& ranks) {
    SparseMatrix part(size, size);
    for (int link = ranks.index(); link + 1 < size - 1; link += ranks.count()) {
      part.coeffRef(link, link + 1) = part.coeffRef(link + 1, link) = -1;
      part.coeffRef(link, link) += 1;
      part.coeffRef(link + 1, link + 1) += 1;
    }
    int count = 0;
    const auto body_of = bodies_of(part, ranks, count);
    EXPECT_EQ(count, 2); // the last unknown, which nobody has, is alone
    EXPECT_EQ(body_of, (std::vector<int>{0, 0, 0, 0, 0, 0, 0, 0, 1}));
  });
}

TEST(WholeMatrix, OfOneProcessIsItsOwn) {
  const auto matrix = test::elastic_block(2, 1, 1);
  EXPECT_EQ(&WholeMatrix(matrix).get(), &matrix);
}

TEST(WholeMatrix, IsSummedOnce) {
  const auto matrix = test::elastic_block(2, 1, 1);
  test::as_ranks(2, [&](const Ranks& ranks) {
    const auto part = part_of(matrix, dealt_out, ranks);
    const WholeMatrix whole(part, ranks);
    const auto& first = whole.get();
    const double sent = ranks.bytes_sent(), told = ranks.bytes_sent() - sent;
    EXPECT_EQ(&whole.get(), &first);
    EXPECT_EQ(ranks.bytes_sent(), sent + 2 * told);
    EXPECT_LE((MatrixXd(first) - MatrixXd(matrix)).norm(), 1e-15 * matrix.norm());
  });
}

} // namespace
} // namespace rubato::linalg::ranked_matrix_test
