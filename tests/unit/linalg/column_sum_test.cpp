// SPDX-License-Identifier: LGPL-3.0-or-later
/// Any number of columns of any length comes to the same sum.
#include "rubato/linalg/column_sum.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

namespace rubato::linalg::column_sum_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

class ColumnSumOf : public testing::TestWithParam<int> {};

TEST_P(ColumnSumOf, IsTheProductWithTheirFactors) {
  const Index columns = GetParam();
  for (const Index rows : {0, 1, 2, 7, 32}) {
    const MatrixXd matrix = MatrixXd::NullaryExpr(
        rows, columns, [](Index i, Index j) { return static_cast<double>(3 * i - 5 * j); });
    const VectorXd factors = VectorXd::LinSpaced(columns, -2, 7);
    const VectorXd start = VectorXd::LinSpaced(rows, 1, 4);
    VectorXd values = start;
    ColumnSum sum(values.data(), rows);
    for (Index j = 0; j < columns; ++j)
      sum.add(factors[j], matrix.col(j).data());
    sum.add_rest();
    const VectorXd expected = start + matrix * factors;
    EXPECT_LE((values - expected).norm(), 1e-12 * (1 + expected.norm()));
    sum.add_rest();
    EXPECT_LE((values - expected).norm(), 1e-12 * (1 + expected.norm())) << "nothing is left to add";
  }
}

INSTANTIATE_TEST_SUITE_P(Columns, ColumnSumOf, testing::Range(0, 10));

} // namespace
} // namespace rubato::linalg::column_sum_test
