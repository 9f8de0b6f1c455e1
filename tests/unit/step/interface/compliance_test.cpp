// SPDX-License-Identifier: LGPL-3.0-or-later
// A resumed run asks for columns in another order than one that was never stopped.
#include "rubato/step/interface/compliance.hpp"

#include <gtest/gtest.h>

#include "unit/linalg/elastic_block.hpp"
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace rubato::step {
namespace {

/// Of two blocks that nothing couples.
Compliance of_blocks(Eigen::Index largest_whole) {
  const auto block = test::elastic_block(5, 4, 3);
  const auto size = static_cast<int>(block.rows());
  linalg::SparseMatrix both(2 * size, 2 * size);
  for (int j = 0; j < 2 * size; ++j)
    for (linalg::SparseMatrix::InnerIterator entry(block, j % size); entry; ++entry)
      both.insert(entry.row() + j / size * size, j) = (1 + j / size) * entry.value();
  std::vector<int> all(static_cast<std::size_t>(2 * size));
  std::iota(all.begin(), all.end(), 0);
  const auto no_limit = std::numeric_limits<std::size_t>::max();
  return {*linalg::SplitFactor::of(both, all, no_limit), all, 2 * size, largest_whole};
}

std::vector<int> positions_of(const Compliance& compliance) {
  std::vector<int> all(compliance.surface().size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

class ComplianceOf : public testing::TestWithParam<int> {};

TEST_P(ComplianceOf, HasTheSameBitsInWhateverOrderItIsAskedFor) {
  auto by_one = of_blocks(GetParam());
  auto backwards = of_blocks(GetParam());
  auto whole = of_blocks(GetParam());
  const auto all = positions_of(whole);
  for (const int position : all)
    by_one.column(position);
  for (std::size_t i = all.size(); i > 0; i -= std::min<std::size_t>(i, 7)) {
    backwards.column(all[i - 1]);
    backwards.column(all[i / 2]);
  }
  const Eigen::MatrixXd expected = whole.between(all);
  EXPECT_EQ(by_one.between(all), expected);
  EXPECT_EQ(backwards.between(all), expected);
}

INSTANTIATE_TEST_SUITE_P(SurfacesWholeUpTo, ComplianceOf, testing::Values(0, 5000),
                         [](const auto& chosen) { return std::to_string(chosen.param); });

TEST(Compliance, IsTheSameWholeAndByColumns) {
  auto whole = of_blocks(5000);
  auto by_columns = of_blocks(0);
  const auto all = positions_of(whole);
  const Eigen::MatrixXd expected = whole.between(all);
  EXPECT_EQ(expected, expected.transpose());
  EXPECT_LE((by_columns.between(all) - expected).lpNorm<Eigen::Infinity>(),
            1e-12 * expected.lpNorm<Eigen::Infinity>());
}

TEST_P(ComplianceOf, MovesTheSurfaceByForcesGivenEitherWay) {
  auto compliance = of_blocks(GetParam());
  const auto all = positions_of(compliance);
  const Eigen::MatrixXd s = compliance.between(all);
  const auto size = static_cast<Eigen::Index>(all.size());
  const std::vector<ForceAt> entries{{3, 1.5}, {40, -2}, {3, 0.5},  {100, 0},
                                     {200, 4}, {41, 1},  {359, -3}, {7, 2}};
  Eigen::VectorXd force = Eigen::VectorXd::Zero(size);
  for (const auto& at : entries)
    force[at.interface_dof] += at.force;
  const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(size, -1, 1);
  const Eigen::VectorXd expected = start + 0.7 * s * force;
  Eigen::VectorXd d = start;
  compliance.add(0.7, force, d);
  EXPECT_LE((d - expected).norm(), 1e-12 * expected.norm());
  d = start;
  compliance.add(0.7, entries, d);
  EXPECT_LE((d - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(ComplianceOf, MovesTheSurfaceByForcesEverywhereOnOneBody) {
  auto compliance = of_blocks(GetParam());
  const auto all = positions_of(compliance);
  const auto size = static_cast<Eigen::Index>(all.size());
  Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(size, -1, 3);
  force.tail(size / 2).setZero();
  const Eigen::VectorXd start = Eigen::VectorXd::LinSpaced(size, 2, 1);
  Eigen::VectorXd d = start;
  compliance.add(-0.7, force, d);
  const Eigen::VectorXd expected = start - 0.7 * compliance.between(all) * force;
  EXPECT_LE((d - expected).norm(), 1e-12 * expected.norm());
  EXPECT_EQ(d.tail(size / 2), start.tail(size / 2));
}

} // namespace
} // namespace rubato::step
