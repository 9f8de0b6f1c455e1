// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/nodal_matrix.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace rubato::linalg::nodal_matrix_test {
namespace {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

class NodalMatrixOf : public testing::TestWithParam<int> {};

TEST_P(NodalMatrixOf, MultipliesAsTheWholeMatrixDoes) {
  const int components = GetParam();
  constexpr int nodes = 9;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(nodes * components, nodes * components);
  for (int i = 0; i < nodes; ++i)
    for (int j = 0; j < nodes; ++j)
      if (const double entry = value(random); entry > 0.2)
        for (int c = 0; c < components; ++c)
          whole(i * components + c, j * components + c) = entry;
  const SparseMatrix sparse = whole.sparseView();
  const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(whole.cols(), [&] { return value(random); });
  EXPECT_LE((NodalMatrix(sparse, components) * x - whole * x).norm(), 1e-14 * (whole * x).norm());
}

INSTANTIATE_TEST_SUITE_P(Components, NodalMatrixOf, testing::Values(1, 2, 3));

TEST(NodalMatrix, RefusesSizesThatDoNotMatch) {
  EXPECT_THROW(NodalMatrix(SparseMatrix(5, 5), 2), std::invalid_argument);
  EXPECT_THROW(NodalMatrix(SparseMatrix(4, 4), 4), std::invalid_argument);
  EXPECT_THROW(NodalMatrix(SparseMatrix(4, 4), 2) * Eigen::VectorXd::Ones(5), std::invalid_argument);
}

} // namespace
} // namespace rubato::linalg::nodal_matrix_test
