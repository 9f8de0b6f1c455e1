// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/gmres.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace rubato::linalg::gmres_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Unsymmetric, its eigenvalues near one.
MatrixXd matrix_near_one(Index size) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1, 1);
  return MatrixXd::Identity(size, size) +
         0.3 / std::sqrt(static_cast<double>(size)) *
             MatrixXd::NullaryExpr(size, size, [&] { return value(random); });
}

class GmresOf : public testing::TestWithParam<Index> {};

TEST_P(GmresOf, LeavesNoMoreThanItMay) {
  const MatrixXd matrix = matrix_near_one(GetParam());
  const VectorXd right = VectorXd::LinSpaced(GetParam(), 1, 2);
  int products = 0;
  const auto x = gmres(
      [&](const VectorXd& y) {
        products += y.isZero(0) ? 0 : 1;
        return VectorXd(matrix * y);
      },
      right, 1e-6, 30);
  ASSERT_TRUE(x);
  EXPECT_LE((matrix * *x - right).norm(), 1.01e-6 * right.norm());
  EXPECT_LE(products, 15);
}

INSTANTIATE_TEST_SUITE_P(Sizes, GmresOf, testing::Values(1, 2, 5, 60));

TEST(Gmres, GivesNothingWhereProductsDoNotSuffice) {
  const MatrixXd matrix = matrix_near_one(60);
  EXPECT_FALSE(gmres([&](const VectorXd& y) { return VectorXd(matrix * y); }, VectorXd::Ones(60), 1e-12, 3));
}

TEST(Gmres, GivesZeroForZero) {
  const auto x = gmres([](const VectorXd& y) { return y; }, VectorXd::Zero(4), 1e-6, 10);
  ASSERT_TRUE(x);
  EXPECT_TRUE(x->isZero(0));
}

TEST(Gmres, GivesNothingThatIsNotFinite) {
  EXPECT_FALSE(gmres([](const VectorXd& y) { return VectorXd(y * std::numeric_limits<double>::quiet_NaN()); },
                     VectorXd::Ones(4), 1e-6, 10));
}

} // namespace
} // namespace rubato::linalg::gmres_test
