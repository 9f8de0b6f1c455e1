// SPDX-License-Identifier: LGPL-3.0-or-later
/// The product is added, and the upper triangle has no say in it.
#include "rubato/linalg/symmetric_product.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace rubato::linalg::symmetric_product_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd lower_triangle(Index size) {
  MatrixXd matrix = MatrixXd::Constant(size, size, std::numeric_limits<double>::quiet_NaN());
  for (Index j = 0; j < size; ++j)
    for (Index i = j; i < size; ++i)
      matrix(i, j) = static_cast<double>(3 * i - 5 * j + 1);
  return matrix;
}

class SymmetricProductOf : public testing::TestWithParam<int> {};

TEST_P(SymmetricProductOf, IsAddedFromTheLowerTriangle) {
  const Index size = GetParam();
  const MatrixXd matrix = lower_triangle(size);
  const VectorXd x = VectorXd::LinSpaced(size, -2, 7);
  const VectorXd start = VectorXd::LinSpaced(size, 1, 4);
  VectorXd y = start;
  add_symmetric_product(-0.5, matrix, x.data(), y.data());
  const MatrixXd whole = matrix.selfadjointView<Eigen::Lower>();
  const VectorXd expected = start - 0.5 * whole * x;
  EXPECT_LE((y - expected).norm(), 1e-12 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(Rows, SymmetricProductOf, testing::Values(0, 1, 2, 7, 64, 129));

TEST(SymmetricProduct, RefusesAMatrixThatIsNotSquare) {
  const VectorXd x = VectorXd::Ones(3);
  VectorXd y = VectorXd::Zero(3);
  EXPECT_THROW(add_symmetric_product(1, MatrixXd::Ones(3, 2), x.data(), y.data()), std::invalid_argument);
}

} // namespace
} // namespace rubato::linalg::symmetric_product_test
