// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/sparse_sum.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <vector>

namespace rubato::linalg::sparse_sum_test {
namespace {

using Eigen::MatrixXd;
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

SparseMatrix with_entries(const std::vector<Eigen::Triplet<double, int>>& entries) {
  SparseMatrix matrix(3, 3);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(SumsOfSparseMatrices, AreThoseOfDenseOnesWhereverTheEntriesAre) {
  const auto some = with_entries({{0, 0, 1.}, {1, 0, 2.}, {2, 2, 3.}});
  for (const auto& other : {with_entries({{0, 0, 4.}, {1, 0, 5.}, {2, 2, 6.}}), // the same places
                            with_entries({{0, 0, 4.}, {2, 0, 5.}, {2, 2, 6.}}), // as many in each column
                            with_entries({{0, 0, 4.}, {1, 1, 5.}, {2, 2, 6.}}), // as many in all
                            with_entries({{0, 1, 4.}}), SparseMatrix(3, 3),
                            with_entries({{1, 0, 4.}, {2, 2, 5.}})}) { // some of the same places
    auto sum = some;
    add_scaled(-2, other, sum);
    EXPECT_EQ(MatrixXd(sum), MatrixXd(some) - 2 * MatrixXd(other));
  }
}

} // namespace
} // namespace rubato::linalg::sparse_sum_test
