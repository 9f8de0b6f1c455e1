// SPDX-License-Identifier: LGPL-3.0-or-later
// A resumed run asks for columns in another order than one that was never stopped.
#include "rubato/step/interface/compliance.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "unit/step/interface/two_blocks_compliance.hpp"
#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rubato::step::compliance_test {
namespace {

using test::compliance_of_two_blocks;
using test::interface_dofs_of;

enum class Computed { whole, by_columns, by_blocks, whole_within };

Compliance compliance_computed(Computed how, const linalg::SparseMatrix& matrix = test::two_blocks()) {
  switch (how) {
  case Computed::whole:
    return test::compliance_of(matrix, 5000);
  case Computed::by_columns:
    return test::compliance_of(matrix, 0);
  case Computed::by_blocks:
    return test::compliance_of(matrix, 5000, {.last = 0});
  default: // case Computed::whole_within
    return test::compliance_of(matrix, 0, {.last = 0, .whole_within = 5000});
  }
}

class ComplianceComputed : public testing::TestWithParam<Computed> {};

TEST_P(ComplianceComputed, HasTheSameBitsInWhateverOrderItIsAskedFor) {
  auto by_one = compliance_computed(GetParam());
  auto backwards = compliance_computed(GetParam());
  auto whole = compliance_computed(GetParam());
  const auto all = interface_dofs_of(whole);
  for (const int position : all)
    by_one.own(position);
  for (std::size_t i = all.size(); i > 0; i -= std::min<std::size_t>(i, 7))
    backwards.between(std::vector{all[i - 1], all[i / 2]});
  const Eigen::MatrixXd expected = whole.between(all);
  EXPECT_EQ(by_one.between(all), expected);
  EXPECT_EQ(backwards.between(all), expected);
}

std::string name_of(const testing::TestParamInfo<Computed>& chosen) {
  constexpr std::array names{"Whole", "ByColumns", "ByBlocks", "WholeWithin"};
  return names[static_cast<std::size_t>(chosen.param)];
}

INSTANTIATE_TEST_SUITE_P(EveryWay, ComplianceComputed,
                         testing::Values(Computed::whole, Computed::by_columns, Computed::by_blocks,
                                         Computed::whole_within),
                         name_of);

/// The order of the interface is the factor's: dofs are those of both.
TEST_P(ComplianceComputed, IsThatOfTheWholeBody) {
  auto whole = compliance_of_two_blocks(5000);
  auto compliance = compliance_computed(GetParam());
  const auto& dofs = whole.dof_of_interface_dof();
  std::vector<int> same;
  for (const int dof : dofs)
    same.push_back(compliance.interface_dof_of_dof()[static_cast<std::size_t>(dof)]);
  const Eigen::MatrixXd expected = whole.between(interface_dofs_of(whole));
  EXPECT_EQ(expected, expected.transpose());
  EXPECT_LE((compliance.between(same) - expected).lpNorm<Eigen::Infinity>(),
            1e-12 * expected.lpNorm<Eigen::Infinity>());
}

TEST_P(ComplianceComputed, IsTheSameForScatteredDofsInAnyOrder) {
  auto compliance = compliance_computed(GetParam());
  auto whole = compliance_computed(GetParam());
  const Eigen::MatrixXd all = whole.between(interface_dofs_of(whole));
  const std::vector<int> scattered{590, 3, 299, 4, 100, 300, 5, 7, 450, 3, 101};
  EXPECT_EQ(compliance.between(scattered), all(scattered, scattered));
  const std::vector<int> of_second{590, 301, 450, 302};
  Eigen::MatrixXd s;
  compliance.within_body(of_second, s);
  EXPECT_EQ(s, all(of_second, of_second));
  for (const int at : scattered)
    EXPECT_EQ(compliance.own(at), all(at, at));
}

TEST_P(ComplianceComputed, MovesTheSurfaceByForcesGivenEitherWay) {
  auto compliance = compliance_computed(GetParam());
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

TEST(Compliance, TakesForcesTogetherByBlocks) {
  EXPECT_FALSE(compliance_computed(Computed::whole).takes_forces_together());
  EXPECT_FALSE(compliance_computed(Computed::by_columns).takes_forces_together());
  EXPECT_FALSE(compliance_computed(Computed::whole_within).takes_forces_together());
  auto compliance = compliance_computed(Computed::by_blocks);
  ASSERT_TRUE(compliance.takes_forces_together());
  const auto all = interface_dofs_of(compliance);
  linalg::SparseMatrix forces(static_cast<int>(all.size()), 3);
  forces.insert(7, 0) = 1.5;
  forces.insert(410, 0) = -2;
  forces.insert(299, 1) = 4;
  forces.insert(300, 2) = -1;
  forces.insert(411, 2) = 0.5;
  const Eigen::MatrixXd f(forces);
  const Eigen::MatrixXd expected = f.transpose() * compliance.between(all) * f;
  EXPECT_LE((compliance.between_forces(forces) - expected).norm(), 1e-12 * expected.norm());
}

TEST_P(ComplianceComputed, MovesTheSurfaceByForcesEverywhereOnOneBody) {
  auto compliance = compliance_computed(GetParam());
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

/// All that is known of S is asked for before and after.
TEST_P(ComplianceComputed, IsThatOfTheMatrixItWasRefactoredWithToTheLastBit) {
  auto compliance = compliance_computed(GetParam());
  const auto all = interface_dofs_of(compliance);
  compliance.between(all);
  const auto size = static_cast<Eigen::Index>(all.size());
  const Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(size, -1, 3);
  for (const auto& [first, second] : {std::pair{1.3, 0.7}, {1.3, 2.1}, {0.9, 2.1}, {0.9, 2.1}}) {
    const auto matrix = test::two_blocks(first, second);
    ASSERT_TRUE(compliance.refactor(matrix));
    auto fresh = compliance_computed(GetParam(), matrix);
    EXPECT_EQ(compliance.own(300), fresh.own(300));
    Eigen::VectorXd d = Eigen::VectorXd::Zero(size);
    Eigen::VectorXd fresh_d = Eigen::VectorXd::Zero(size);
    compliance.add(1, force, d);
    fresh.add(1, force, fresh_d);
    EXPECT_EQ(d, fresh_d);
    EXPECT_EQ(compliance.between(all), fresh.between(all));
    EXPECT_EQ(compliance.solve(force), fresh.solve(force));
    EXPECT_EQ(compliance.surface_of(compliance.forward(force)), fresh.surface_of(fresh.forward(force)));
  }
}

/// The first body has its new values before the second one turns out to have none.
TEST_P(ComplianceComputed, ForgetsWhatItKnewWhenAMatrixCannotBeFactored) {
  auto compliance = compliance_computed(GetParam());
  const auto all = interface_dofs_of(compliance);
  compliance.between(all);
  EXPECT_FALSE(compliance.refactor(test::two_blocks(3, -1)));
  ASSERT_TRUE(compliance.refactor(test::two_blocks(3, 2)));
  EXPECT_EQ(compliance.between(all), compliance_computed(GetParam(), test::two_blocks(3, 2)).between(all));
}

TEST(Compliance, IsMadeOfAnAnalysisThatHasNoValuesYet) {
  const auto matrix = test::two_blocks();
  auto factor = linalg::SplitFactor::analysed(-1 * matrix, std::vector{0, 1, 2, 301}, std::size_t{1} << 30U);
  Compliance compliance(std::move(factor), constraint::Reduction(static_cast<int>(matrix.rows()), {}));
  EXPECT_EQ(compliance.size(), 4);
  EXPECT_THROW(compliance.own(0), std::logic_error);
  EXPECT_FALSE(compliance.refactor(-1 * matrix));
  ASSERT_TRUE(compliance.refactor(matrix));
  auto fresh = linalg::SplitFactor::of(matrix, std::vector{0, 1, 2, 301}, std::size_t{1} << 30U);
  EXPECT_EQ(compliance.between(std::vector{0, 1, 2}), fresh->compliance(0));
  EXPECT_EQ(compliance.own(3), fresh->compliance(1)(0, 0));
}

/// Two blocks of 2 and 3 unknowns that nothing couples but relations: dofs 5 and 6 depend on both, 7 on the
/// first block alone, 8 on a dof that is not on the surface of its own.
class RelatedCompliance : public testing::Test {
protected:
  static constexpr int dofs = 9;

  static Eigen::MatrixXd matrix() {
    Eigen::MatrixXd a = Eigen::MatrixXd::Zero(5, 5);
    a.topLeftCorner(2, 2) << 4, 1, 1, 3;
    a.bottomRightCorner(3, 3) << 5, 1, 0, 1, 6, 2, 0, 2, 7;
    return a;
  }
  static constraint::Reduction reduction() {
    return {dofs,
            {},
            {{5, {{0, 0.5}, {2, -2}}, {}, {}},
             {6, {{1, 1}, {3, 1}}, {}, {}},
             {7, {{0, 3}, {1, -1}}, {}, {}},
             {8, {{4, 2}}, {}, {}}},
            {}};
  }
  static Compliance compliance() {
    const linalg::SparseMatrix a = matrix().sparseView();
    auto factor = linalg::SplitFactor::of(a, std::vector{0, 1, 2, 3, 4}, std::size_t{1} << 30U);
    return {std::move(*factor), reduction(), std::vector{5, 6, 7, 8}};
  }
  /// B S Bᵀ of these dofs.
  static Eigen::MatrixXd expected(const std::vector<int>& chosen) {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(chosen.size()), 5);
    for (std::size_t i = 0; i < chosen.size(); ++i)
      reduction().for_each_unknown(
          chosen[i], [&](int unknown, double c) { b(static_cast<Eigen::Index>(i), unknown) = c; });
    return b * test::inverse(matrix()) * b.transpose();
  }
};

TEST_F(RelatedCompliance, IsThatOfTheUnknownsBetweenTheRowsOfTheRelations) {
  auto c = compliance();
  ASSERT_EQ(c.size(), dofs);
  EXPECT_EQ(c.body_starts(), (std::vector<int>{0, dofs})) << "tied bodies are one";
  const auto s = c.between(interface_dofs_of(c));
  EXPECT_LE((s - expected(c.dof_of_interface_dof())).cwiseAbs().maxCoeff(), 1e-15);
  const std::vector<int> some{c.interface_dof_of_dof()[6], c.interface_dof_of_dof()[2]};
  EXPECT_LE((c.between(some) - expected({6, 2})).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(c.own(c.interface_dof_of_dof()[7]), expected({7})(0, 0), 1e-15);
}

TEST_F(RelatedCompliance, MovesAllDofsByForcesOnAny) {
  auto c = compliance();
  Eigen::VectorXd force = Eigen::VectorXd::Zero(dofs);
  std::vector<ForceAt> entries;
  for (const int dof : {5, 7, 3}) {
    const int at = c.interface_dof_of_dof()[static_cast<std::size_t>(dof)];
    force[at] = dof;
    entries.push_back({at, static_cast<double>(dof)});
  }
  const Eigen::VectorXd wanted = 0.5 * expected(c.dof_of_interface_dof()) * force;
  Eigen::VectorXd d = Eigen::VectorXd::Zero(dofs);
  c.add(0.5, force, d);
  EXPECT_LE((d - wanted).cwiseAbs().maxCoeff(), 1e-14);
  Eigen::VectorXd by_entries = Eigen::VectorXd::Zero(dofs);
  c.add(0.5, entries, by_entries);
  EXPECT_EQ(by_entries, d);
  Eigen::VectorXd half_way = c.forward(Eigen::VectorXd::Zero(5));
  c.load_surface(0.5 * force, half_way);
  EXPECT_LE((c.surface_of(half_way) - wanted).cwiseAbs().maxCoeff(), 1e-14);
}

TEST_F(RelatedCompliance, KeepsItsRelationsWithAnotherMatrix) {
  auto c = compliance();
  const auto dofs_before = c.dof_of_interface_dof();
  const auto all = interface_dofs_of(c);
  const Eigen::MatrixXd before = c.between(all);
  ASSERT_TRUE(c.refactor(linalg::SparseMatrix((0.25 * matrix()).sparseView())));
  EXPECT_EQ(c.dof_of_interface_dof(), dofs_before);
  EXPECT_EQ(c.between(all), 4 * before) << "powers of two round nothing";
  EXPECT_EQ(c.own(2), 4 * before(2, 2));
}

TEST_F(RelatedCompliance, LeavesBodiesApartThatNoRelationTies) {
  const linalg::SparseMatrix a = matrix().sparseView();
  auto factor = linalg::SplitFactor::of(a, std::vector{0, 1, 2, 3, 4}, std::size_t{1} << 30U);
  Compliance c(std::move(*factor), reduction(), std::vector{7});
  EXPECT_EQ(c.size(), 6);
  EXPECT_EQ(c.body_starts().size(), 3U);
  EXPECT_EQ(c.interface_dof_of_dof()[5], -1);
}

} // namespace
} // namespace rubato::step::compliance_test
