// SPDX-License-Identifier: LGPL-3.0-or-later
// A resumed run asks for columns in another order than one that was never stopped.
#include "rubato/step/interface/compliance.hpp"

#include <gtest/gtest.h>

#include "unit/step/interface/two_blocks_compliance.hpp"
#include <string>
#include <vector>

namespace rubato::step {
namespace {

using test::compliance_of_two_blocks;
using test::interface_dofs_of;

class ComplianceOf : public testing::TestWithParam<int> {};

TEST_P(ComplianceOf, HasTheSameBitsInWhateverOrderItIsAskedFor) {
  auto by_one = compliance_of_two_blocks(GetParam());
  auto backwards = compliance_of_two_blocks(GetParam());
  auto whole = compliance_of_two_blocks(GetParam());
  const auto all = interface_dofs_of(whole);
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
  auto whole = compliance_of_two_blocks(5000);
  auto by_columns = compliance_of_two_blocks(0);
  const auto all = interface_dofs_of(whole);
  const Eigen::MatrixXd expected = whole.between(all);
  EXPECT_EQ(expected, expected.transpose());
  EXPECT_LE((by_columns.between(all) - expected).lpNorm<Eigen::Infinity>(),
            1e-12 * expected.lpNorm<Eigen::Infinity>());
}

TEST_P(ComplianceOf, MovesTheSurfaceByForcesGivenEitherWay) {
  auto compliance = compliance_of_two_blocks(GetParam());
  const auto all = interface_dofs_of(compliance);
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
  auto compliance = compliance_of_two_blocks(GetParam());
  const auto all = interface_dofs_of(compliance);
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
