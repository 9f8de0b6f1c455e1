// SPDX-License-Identifier: LGPL-3.0-or-later
// The linear system of an iteration on all unknowns.
#include "rubato/domain/domain.hpp"
#include "rubato/step/full/linear_step.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <algorithm>
#include <functional>
#include <random>
#include <set>

namespace rubato::step::linear_step_test {
namespace {

using contact::ContactSystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two squares in a row, held at the left: nodes 0 and 3 in both directions, the dofs 0, 1, 6 and 7.
const std::string strip = R"(
mesh:
  generate:
    - {name: strip, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1], sides: {left: wall}}
physics: plane_strain
materials: {rubber: {young: 3, poisson: 0.3}}
supports: [{on: wall, fix: [x, y]}]
time: {scheme: static, step: 1, end: 1}
)";

MatrixXd dense(const contact::Triplets& triplets, Index rows, Index columns) {
  MatrixXd matrix = MatrixXd::Zero(rows, columns);
  for (const auto& entry : triplets)
    matrix(entry.row(), entry.col()) += entry.value();
  return matrix;
}

class WholeStrip : public testing::Test {
protected:
  static constexpr double weight = 0.7;

  std::optional<LinearSolution> solve(const ContactSystem& contact) const {
    return solve_full({model_, matrix_, weight, contact, residual_});
  }
  /// Keeps dof a as far from dof b as it is, but for `apart`; no multiplier does more than push them.
  static void tie(ContactSystem& contact, int multiplier, int a, int b, double apart, double size = 1) {
    for (const auto& [dof, sign] : {std::pair{a, size}, {b, -size}}) {
      contact.force_by_multiplier.emplace_back(dof, multiplier, sign);
      contact.equation_by_dof.emplace_back(multiplier, dof, sign);
    }
    contact.equations[multiplier] = -size * apart;
  }

  test::BuiltModel model_ = test::model_of(strip);
  Index dofs_ = model_.dofs.dof_count;
  model::SparseMatrix matrix_ = model_.reduction.reduced(model_.domain.initial_tangent());
  VectorXd residual_ = VectorXd::LinSpaced(model_.reduction.unknown_count(), -1, 2);
};

TEST_F(WholeStrip, MovesAsWithoutContactWhereThereIsNone) {
  const auto solution = solve(ContactSystem(dofs_, 0));
  ASSERT_TRUE(solution);
  EXPECT_EQ(solution->multipliers.size(), 0);
  EXPECT_LE((matrix_ * solution->displacement + residual_).norm(), 1e-12);
}

/// Any numbers, on held dofs too, which stay where they are.
TEST_F(WholeStrip, FulfilsAllEquationsOfItsFreeDofsAndMultipliers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1, 1);
  constexpr int multipliers = 3;
  ContactSystem contact(dofs_, multipliers);
  for (int entry = 0; entry < 60; ++entry) {
    const auto dof = [&] { return static_cast<int>(random() % static_cast<unsigned>(dofs_)); };
    const auto multiplier = [&] { return static_cast<int>(random() % multipliers); };
    contact.force_by_dof.emplace_back(dof(), dof(), number(random));
    contact.force_by_multiplier.emplace_back(dof(), multiplier(), number(random));
    contact.equation_by_dof.emplace_back(multiplier(), dof(), number(random));
    contact.equation_by_multiplier.emplace_back(multiplier(), multiplier(), number(random));
  }
  contact.equations << 0.3, -2, 1;
  const auto solution = solve(contact);
  ASSERT_TRUE(solution);
  const VectorXd d = model_.reduction.scatter(solution->displacement);
  const VectorXd& l = solution->multipliers;
  const VectorXd force = dense(contact.force_by_dof, dofs_, dofs_) * d +
                         dense(contact.force_by_multiplier, dofs_, multipliers) * l;
  EXPECT_LE((matrix_ * solution->displacement + weight * model_.reduction.gather(force) + residual_).norm(),
            1e-11);
  EXPECT_LE((dense(contact.equation_by_dof, multipliers, dofs_) * d +
             dense(contact.equation_by_multiplier, multipliers, multipliers) * l + contact.equations)
                .norm(),
            1e-11);
}

TEST_F(WholeStrip, TakesDofsToTheDistanceThatTheyAreToHave) {
  ContactSystem contact(dofs_, 1);
  tie(contact, 0, 4, 10, 0.125);
  const auto solution = solve(contact);
  ASSERT_TRUE(solution);
  const auto d = model_.reduction.scatter(solution->displacement);
  EXPECT_NEAR(d[4] - d[10], 0.125, 1e-13);
  EXPECT_NE(solution->multipliers[0], 0);
}

/// The second one between held dofs; the third one says as little but for rounding.
TEST_F(WholeStrip, LeavesMultipliersThatNothingFreeAnswersTo) {
  ContactSystem alone(dofs_, 1);
  tie(alone, 0, 4, 10, 0.125);
  ContactSystem contact(dofs_, 3);
  tie(contact, 0, 4, 10, 0.125);
  tie(contact, 1, 0, 7, 5);
  tie(contact, 2, 5, 11, 5, 1e-14);
  contact.equations[2] = 5;
  const auto expected = solve(alone);
  const auto solution = solve(contact);
  ASSERT_TRUE(expected && solution);
  EXPECT_EQ(solution->multipliers[1], 0);
  EXPECT_EQ(solution->multipliers[2], 0);
  EXPECT_NEAR(solution->multipliers[0], expected->multipliers[0], 1e-12);
  EXPECT_LE((solution->displacement - expected->displacement).norm(), 1e-12);
}

/// As that of an open point, −λ/c = 0, whatever the size of its entry.
TEST_F(WholeStrip, FulfilsEquationsOfMultipliersAlone) {
  ContactSystem contact(dofs_, 2);
  tie(contact, 0, 4, 10, 0.125);
  contact.equation_by_multiplier.emplace_back(1, 1, -1e-15);
  contact.equations[1] = -3e-15;
  const auto solution = solve(contact);
  ASSERT_TRUE(solution);
  EXPECT_NEAR(solution->multipliers[1], -3, 1e-12);
}

TEST_F(WholeStrip, HasNoSolutionWhereTheSameIsAskedTwice) {
  ContactSystem contact(dofs_, 2);
  tie(contact, 0, 4, 10, 0.125);
  tie(contact, 1, 4, 10, 0.25);
  EXPECT_FALSE(solve(contact));
}

std::set<std::pair<mesh::NodeIndex, int>> surface_dofs(const test::ModelParts& model) {
  std::set<std::pair<mesh::NodeIndex, int>> found;
  for (const int unknown : surface_unknowns(model)) {
    const int dof = model.reduction.free_dofs()[static_cast<std::size_t>(unknown)];
    found.emplace(model.node_of(dof), dof - model.dofs.dof(model.node_of(dof), 0));
  }
  return found;
}

TEST(UnknownsOfSurfaces, AreThoseOfBothSidesThatAreFree) {
  const auto model = test::model_of(test::two_beams); // 21 nodes a side, the first one clamped
  const auto unknowns = surface_unknowns(model);
  EXPECT_EQ(unknowns.size(), 2U * 20U * 2U);
  EXPECT_TRUE(std::ranges::is_sorted(unknowns, std::less_equal<>()));
  for (const auto& [node, component] : surface_dofs(model)) {
    EXPECT_EQ(model.mesh.points[static_cast<std::size_t>(node)].y(), 0);
    EXPECT_GT(model.mesh.points[static_cast<std::size_t>(node)].x(), 0);
  }
}

/// The side x = 0 is held along x: each of four surfaces has four nodes with eight dofs, one of them held.
TEST(UnknownsOfSurfaces, OfSeveralZonesStandOnce) {
  const auto model = test::model_of(test::three_blocks);
  EXPECT_EQ(surface_unknowns(model).size(), 4U * 7U);
  const auto twice = test::model_of(
      test::three_blocks, {{"contact.again", "{master: mid_bottom, slave: low_top, integration: nodes}"}});
  EXPECT_EQ(surface_unknowns(twice), surface_unknowns(model));
}

} // namespace
} // namespace rubato::step::linear_step_test
