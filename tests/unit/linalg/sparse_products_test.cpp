// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/sparse_products.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rubato::linalg::sparse_products_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// 1 0 2
/// 0 3 0
/// 2 5 4, whose upper triangle lacks the 5.
SparseMatrix matrix() {
  const std::vector<Eigen::Triplet<double, int>> entries{{0, 0, 1}, {2, 0, 2}, {1, 1, 3},
                                                         {2, 1, 5}, {0, 2, 2}, {2, 2, 4}};
  SparseMatrix matrix(3, 3);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

const VectorXd x = VectorXd::LinSpaced(3, 1, 3);

TEST(SparseProducts, MultiplyVectors) {
  EXPECT_EQ(product(matrix(), x), VectorXd({{7, 6, 24}}));
  EXPECT_EQ(transposed_product(matrix(), x), VectorXd({{7, 21, 14}}));
  EXPECT_EQ(symmetric_product(matrix(), x), VectorXd({{7, 21, 24}}));
}

TEST(SparseProducts, MultiplyEachColumn) {
  MatrixXd columns(3, 2);
  columns.col(0) = x;
  columns.col(1) = 2 * x;
  EXPECT_EQ(product(matrix(), columns).col(1), 2 * product(matrix(), x));
  EXPECT_EQ(transposed_product(matrix(), columns).col(1), 2 * transposed_product(matrix(), x));
}

TEST(SparseProducts, GiveColumnsAndTheirGramMatrix) {
  EXPECT_EQ(dense_columns(matrix(), 1, 2), MatrixXd({{0, 2}, {3, 0}, {5, 4}}));
  EXPECT_EQ(gram_of_columns(matrix()), MatrixXd({{5, 10, 10}, {10, 34, 20}, {10, 20, 20}}));
}

} // namespace
} // namespace rubato::linalg::sparse_products_test
