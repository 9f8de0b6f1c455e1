// SPDX-License-Identifier: LGPL-3.0-or-later
/// Equations against the displacements that the Reduction made of them leaves.
#include "rubato/constraint/elimination.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <array>
#include <random>

namespace rubato::constraint::elimination_test {
namespace {

using Eigen::VectorXd;

constexpr std::array instants{0.0, 0.7, 2.0};
const Function ramp{{0, 2}, {0, 8}};

double left_side(const Equation& equation, const VectorXd& u) {
  double sum = 0;
  for (const auto& term : equation.terms)
    sum += term.coefficient * u[term.dof];
  return sum;
}

/// u of some unknowns at an instant, right sides as `equations` number them.
VectorXd displacements(int dofs, const std::vector<PrescribedDof>& prescribed,
                       const std::vector<Equation>& equations, const Elimination& found, double t) {
  std::vector<ImposedValue> values;
  for (const auto& equation : equations)
    values.push_back(equation.value);
  const Reduction reduction(dofs, prescribed, found.dependents, values);
  VectorXd q(reduction.unknown_count());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = std::sin(3.0 * static_cast<double>(i) + 1);
  VectorXd u = reduction.scatter(q);
  reduction.impose(t, u);
  return u;
}

TEST(Elimination, LeavesDisplacementsThatFulfilEveryEquation) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(-1, 1);
  std::uniform_int_distribution<int> dof(0, 29);
  for (int round = 0; round < 20; ++round) {
    const std::vector<PrescribedDof> prescribed{{3, 0.5, {}}, {11, 2, ramp}};
    std::vector<Equation> equations;
    for (int i = 0; i < 15; ++i) {
      Equation equation{{}, {number(engine), i % 2 == 0 ? std::optional(ramp) : std::nullopt}, i};
      for (int k = 0; k < 4; ++k)
        equation.terms.push_back({dof(engine), number(engine)});
      equations.push_back(std::move(equation));
    }
    const auto found = eliminate(prescribed, equations, instants);
    ASSERT_TRUE(found.contradictions.empty());
    EXPECT_EQ(found.dependents.size(), equations.size());
    for (const double t : instants) {
      const auto u = displacements(30, prescribed, equations, found, t);
      for (const auto& equation : equations)
        EXPECT_NEAR(left_side(equation, u), value_at(equation.value, t), 1e-11 * u.lpNorm<Eigen::Infinity>());
    }
  }
}

TEST(Elimination, SolvesForTheFirstDofUnlessItsCoefficientIsSmall) {
  const std::vector<Equation> equations{{{{0, 0.2}, {1, 1}}, {}, 0}, {{{2, 0.01}, {3, 1}}, {}, 1}};
  const auto found = eliminate({}, equations, instants);
  ASSERT_EQ(found.dependents.size(), 2U);
  EXPECT_EQ(found.dependents[0].dof, 0);
  EXPECT_EQ(found.dependents[0].of, (std::vector<Term>{{1, -5}}));
  EXPECT_EQ(found.dependents[1].dof, 3);
}

TEST(Elimination, NamesWhatFollowsFromTheRest) {
  const std::vector<PrescribedDof> prescribed{{4, 1, ramp}};
  const std::vector<Equation> equations{{{{0, 1}, {1, -1}}, {}, 0},
                                        {{{1, 1}, {2, -1}}, {0.5, {}}, 1},
                                        {{{0, 2}, {2, -2}}, {1, {}}, 2},
                                        {{{4, 3}}, {3, ramp}, 3}};
  const auto found = eliminate(prescribed, equations, instants);
  EXPECT_EQ(found.redundant, (std::vector<int>{2, 3}));
  EXPECT_TRUE(found.contradictions.empty());
  EXPECT_EQ(found.dependents.size(), 2U);
}

TEST(Elimination, NamesWhatContradictsOthersOrSupports) {
  const std::vector<PrescribedDof> prescribed{{4, 1, ramp}};
  const std::vector<Equation> equations{{{{0, 1}, {1, -1}}, {}, 0},
                                        {{{1, 1}, {2, -1}}, {0.5, {}}, 1},
                                        {{{0, 2}, {2, -2}}, {0.9, {}}, 2},
                                        {{{4, 3}}, {3, {}}, 3}};
  const auto found = eliminate(prescribed, equations, instants);
  ASSERT_EQ(found.contradictions.size(), 2U);
  EXPECT_EQ(found.contradictions[0].equation, 2);
  EXPECT_EQ(found.contradictions[0].others, (std::vector<int>{0, 1}));
  EXPECT_NEAR(std::abs(found.contradictions[0].excess), 0.1, 1e-15);
  EXPECT_EQ(found.contradictions[1].equation, 3);
  EXPECT_EQ(found.contradictions[1].dofs, (std::vector<int>{4}));
  EXPECT_EQ(found.contradictions[1].at, 2) << "where most is left";
  EXPECT_NEAR(std::abs(found.contradictions[1].excess), 21, 1e-14);
}

/// A chain whose every equation is solved for the dof that those before depend on.
TEST(Elimination, FollowsChains) {
  constexpr int count = 200;
  std::vector<Equation> equations;
  for (int i = 0; i + 1 < count; ++i)
    equations.push_back({{{i, 1}, {i + 1, -1}}, {0.5, {}}, i});
  const auto found = eliminate({}, equations, instants);
  ASSERT_EQ(found.dependents.size(), count - 1U);
  const auto u = displacements(count, {}, equations, found, 0);
  for (int i = 0; i < count; ++i)
    EXPECT_NEAR(u[i] - u[count - 1], 0.5 * (count - 1 - i), 1e-12);
}

TEST(Elimination, TakesADofThatOccursTwiceInAnEquation) {
  const std::vector<Equation> equations{{{{0, 1}, {1, 1}, {0, -1}}, {2, {}}, 0}};
  const auto found = eliminate({}, equations, instants);
  ASSERT_EQ(found.dependents.size(), 1U);
  EXPECT_EQ(found.dependents[0].dof, 1);
  EXPECT_TRUE(found.dependents[0].of.empty());
}

/// Of two equations without right sides the one that has a multiplier is counted by what it gives.
TEST(Elimination, CountsEquationsThatHaveMultipliers) {
  std::vector<Equation> equations{{{{0, 1}, {1, -1}}, {}, 0}, {{{1, 1}, {2, -2}}, {}, 1, true}};
  const auto found = eliminate({}, equations, instants);
  ASSERT_EQ(found.dependents.size(), 2U);
  for (const auto& dependent : found.dependents)
    EXPECT_EQ(dependent.given, (std::vector<Term>{{1, 1}})) << dependent.dof;
}

} // namespace
} // namespace rubato::constraint::elimination_test
