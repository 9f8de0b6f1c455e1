// SPDX-License-Identifier: LGPL-3.0-or-later
/// A made-up reduction against its matrix T.
#include "rubato/constraint/reduction.hpp"
#include "rubato/core/time_integral.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace rubato::constraint::reduction_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int dof_count = 9;
constexpr double now = 1.5;

const Function ramp{{0, 2}, {0, 8}};

/// Dofs 0, 3, 4 and 8 are prescribed: held, moved, moved by a function and held.
Reduction some_reduction() {
  return {dof_count, {{0, 0, {}}, {3, -0.25, {}}, {4, 0.5, ramp}, {8, 0, {}}}};
}

MatrixXd dense_t() {
  MatrixXd t = MatrixXd::Zero(dof_count, 5);
  Index unknown = 0;
  for (const Index dof : {1, 2, 5, 6, 7})
    t(dof, unknown++) = 1;
  return t;
}

VectorXd dense_g() {
  VectorXd g = VectorXd::Zero(dof_count);
  g[3] = -0.25;
  g[4] = 0.5 * 6;
  return g;
}

/// Numbers without a pattern.
VectorXd numbers(Index size) {
  VectorXd values(size);
  for (Index i = 0; i < size; ++i)
    values[i] = std::sin(3.0 * static_cast<double>(i) + 1);
  return values;
}

/// A full matrix, not symmetric, and one with entries left out.
SparseMatrix some_matrix(bool sparse) {
  MatrixXd dense(dof_count, dof_count);
  for (Index column = 0; column < dof_count; ++column)
    for (Index row = 0; row < dof_count; ++row)
      dense(row, column) = sparse && (row * 5 + column) % 3 == 0 ? 0 : std::cos(7.0 * row + 2.0 * column);
  return dense.sparseView();
}

TEST(Reduction, CountsWhatIsUnknown) {
  const auto reduction = some_reduction();
  EXPECT_EQ(reduction.dof_count(), dof_count);
  EXPECT_EQ(reduction.unknown_count(), 5);
  EXPECT_EQ(reduction.prescribed().size(), 4U);
  const MatrixXd t = dense_t();
  for (int dof = 0; dof < dof_count; ++dof) {
    EXPECT_EQ(reduction.is_prescribed(dof), t.row(dof).isZero()) << dof;
    if (!reduction.is_prescribed(dof)) {
      EXPECT_EQ(t(dof, reduction.unknown_of(dof)), 1) << dof;
      EXPECT_EQ(reduction.free_dofs()[static_cast<std::size_t>(reduction.unknown_of(dof))], dof);
    }
  }
}

TEST(Reduction, GathersAndScattersAsItsMatrixDoes) {
  const auto reduction = some_reduction();
  const VectorXd full = numbers(dof_count);
  const VectorXd unknowns = numbers(5);
  EXPECT_EQ(reduction.gather(full), VectorXd(dense_t().transpose() * full));
  EXPECT_EQ(reduction.scatter(unknowns), VectorXd(dense_t() * unknowns));
}

TEST(Reduction, ReducesMatricesAsItsMatrixDoes) {
  const auto reduction = some_reduction();
  for (const bool sparse : {false, true}) {
    const auto matrix = some_matrix(sparse);
    const auto reduced = reduction.reduced(matrix);
    EXPECT_EQ(MatrixXd(reduced), MatrixXd(dense_t().transpose() * MatrixXd(matrix) * dense_t()));
    EXPECT_LT(reduced.nonZeros(), matrix.nonZeros());
  }
}

TEST(Reduction, PrescribesWhatItsFunctionsSay) {
  const auto reduction = some_reduction();
  EXPECT_EQ(reduction.imposed(now), dense_g());
  const VectorXd unknowns = numbers(5);
  VectorXd u = reduction.scatter(unknowns);
  reduction.impose(now, u);
  EXPECT_EQ(u, VectorXd(dense_t() * unknowns + dense_g()));
  EXPECT_EQ(reduction.gather(u), unknowns);
}

TEST(Reduction, CorrectsAMotionToWhatIsPrescribed) {
  const auto reduction = some_reduction();
  const VectorXd u = numbers(dof_count);
  const VectorXd d = reduction.correction(now, u);
  EXPECT_TRUE(reduction.gather(d).isZero(0));
  const VectorXd wanted = dense_t() * dense_t().transpose() * u + dense_g();
  EXPECT_LE((u + d - wanted).lpNorm<Eigen::Infinity>(), 1e-15);
}

/// Forces on free dofs and reactions together are all there is.
TEST(Reduction, LeavesToReactionsWhatNoUnknownBalances) {
  const auto reduction = some_reduction();
  const VectorXd residual = numbers(dof_count);
  EXPECT_EQ(reduction.scatter(reduction.gather(residual)) + reduction.reaction(residual), residual);
  EXPECT_TRUE(reduction.gather(reduction.reaction(residual)).isZero(0));
}

/// The same with dofs that depend on others: u₂ = 0.5 u₁ − 2 u₅ + 3 u₄ + 4 r, u₆ = −u₇; r is the ramp.
Reduction related_reduction() {
  return {dof_count,
          {{0, 0, {}}, {3, -0.25, {}}, {4, 0.5, ramp}, {8, 0, {}}},
          {{2, {{1, 0.5}, {5, -2}}, {{4, 3}}, {{0, 4}}}, {6, {{7, -1}}, {}, {}}},
          {{1, ramp}}};
}

MatrixXd related_t() {
  MatrixXd t = MatrixXd::Zero(dof_count, 3);
  t(1, 0) = t(5, 1) = t(7, 2) = 1;
  t.row(2) << 0.5, -2, 0;
  t(6, 2) = -1;
  return t;
}

VectorXd related_g() {
  VectorXd g = dense_g();
  g[2] = 3 * g[4] + 4 * 6;
  return g;
}

TEST(RelatedReduction, WorksAsItsMatrixDoes) {
  const auto reduction = related_reduction();
  ASSERT_EQ(reduction.unknown_count(), 3);
  const MatrixXd t = related_t();
  const VectorXd full = numbers(dof_count);
  const VectorXd unknowns = numbers(3);
  const auto near = [](const MatrixXd& a, const MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); };
  EXPECT_LE(near(reduction.gather(full), t.transpose() * full), 1e-15);
  EXPECT_LE(near(reduction.gather_magnitudes(full.cwiseAbs()), t.cwiseAbs().transpose() * full.cwiseAbs()),
            1e-15);
  EXPECT_EQ(reduction.scatter(unknowns), VectorXd(t * unknowns));
  for (const bool sparse : {false, true})
    EXPECT_LE(near(reduction.reduced(some_matrix(sparse)), t.transpose() * MatrixXd(some_matrix(sparse)) * t),
              1e-14);
  MatrixXd rows = MatrixXd::Zero(dof_count, 3);
  for (int dof = 0; dof < dof_count; ++dof)
    reduction.for_each_unknown(dof, [&](int unknown, double c) { rows(dof, unknown) += c; });
  EXPECT_EQ(rows, t);
}

TEST(RelatedReduction, ImposesSupportsAndRelations) {
  const auto reduction = related_reduction();
  EXPECT_EQ(reduction.imposed(now), related_g());
  VectorXd u = reduction.scatter(numbers(3));
  reduction.impose(now, u);
  EXPECT_LE((u - related_t() * numbers(3) - related_g()).lpNorm<Eigen::Infinity>(), 1e-14);
  const VectorXd other = numbers(dof_count);
  const VectorXd corrected = other + reduction.correction(now, other);
  VectorXd wanted = other;
  reduction.impose(now, wanted);
  EXPECT_LE((corrected - wanted).lpNorm<Eigen::Infinity>(), 1e-14);
  EXPECT_EQ(corrected[1], other[1]) << "free dofs stay";
  VectorXd rates = other;
  reduction.relate(rates);
  EXPECT_EQ(rates[6], -other[7]);
  EXPECT_EQ(rates[0], other[0]) << "supports say nothing of rates";
}

/// Forces that no unknown feels, Tᵀ R = 0, are on dofs that react.
TEST(RelatedReduction, HasReactionsOnAllDofsOfARelation) {
  const auto reduction = related_reduction();
  EXPECT_EQ(reduction.reacting_dofs(), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  VectorXd force = VectorXd::Zero(dof_count);
  force[2] = 1;
  force[1] = -0.5;
  force[5] = 2;
  EXPECT_TRUE(reduction.gather(force).isZero(0));
  EXPECT_EQ(reduction.reaction(force), force);
}

TEST(RelatedReduction, MayHoldADofByARelationAlone) {
  const Reduction held(2, {{0, 2, {}}}, {{1, {}, {{0, 3}}, {}}}, {});
  EXPECT_TRUE(held.is_prescribed(1));
  EXPECT_EQ(held.unknown_count(), 0);
  EXPECT_EQ(held.imposed(0), Eigen::Vector2d(2, 6));
}

TEST(RelatedReduction, RefusesDofsThatDependOnOnesThatAreNotFree) {
  EXPECT_THROW(Reduction(3, {{0, 0, {}}}, {{1, {{0, 1}}, {}, {}}}, {}), std::invalid_argument);
  EXPECT_THROW(Reduction(3, {}, {{0, {{1, 1}}, {}, {}}, {1, {{2, 1}}, {}, {}}}, {}), std::invalid_argument);
  EXPECT_THROW(Reduction(3, {{1, 0, {}}}, {{1, {{0, 1}}, {}, {}}}, {}), std::invalid_argument);
  EXPECT_THROW(Reduction(3, {}, {{2, {}, {}, {}}, {1, {}, {}, {}}}, {}), std::invalid_argument);
}

TEST(Reduction, MayPrescribeAllOrNothing) {
  const Reduction nothing(2, {});
  EXPECT_EQ(nothing.unknown_count(), 2);
  EXPECT_EQ(nothing.gather(numbers(2)), numbers(2));
  const Reduction all(2, {{0, 1, {}}, {1, 2, {}}});
  EXPECT_EQ(all.unknown_count(), 0);
  EXPECT_EQ(all.imposed(0), Eigen::Vector2d(1, 2));
  EXPECT_EQ(Reduction().dof_count(), 0);
}

TEST(Reduction, RefusesDofsThatDoNotAscendOrAreNotThere) {
  EXPECT_THROW(Reduction(3, {{1, 0, {}}, {1, 0, {}}}), std::invalid_argument);
  EXPECT_THROW(Reduction(3, {{2, 0, {}}, {1, 0, {}}}), std::invalid_argument);
  EXPECT_THROW(Reduction(3, {{3, 0, {}}}), std::invalid_argument);
  EXPECT_THROW(Reduction(3, {{-1, 0, {}}}), std::invalid_argument);
}

/// Three nodes in the plane; the base moves by 2t along x and by t² as the integral of 2t along y.
Reduction carried() {
  Reduction reduction{6, {{0, 0.5, {}}}, {{3, {{5, 1}}, {}, {}}, {4, {{2, 2}}, {{0, 1}}, {}}}, {}};
  FieldFunction along_x{.number = 2, .expression = {}, .function = Function({0, 10}, {0, 10}), .path = "x"};
  FieldFunction along_y{.number = 2, .expression = {}, .function = Function({0, 10}, {0, 10}), .path = "y"};
  reduction.carry({along_x, integrated(along_y, 1, 0, 10), std::nullopt}, 2);
  return reduction;
}

/// u_1 = 2 u_0 + r_0 − 3 r_1 and u_3 = r_1 + u_2, where u_2 is prescribed.
TEST(Multipliers, AreWorksOfTheReactionByTheRightSides) {
  const Reduction reduction(4, {{2, 1, ramp}},
                            {{1, {{0, 2}}, {}, {{0, 1}, {1, -3}}}, {3, {}, {{2, 1}}, {{1, 1}}}},
                            {{5, {}}, {7, {}}});
  const VectorXd reaction = VectorXd::LinSpaced(4, 1, 4);
  EXPECT_EQ(reduction.multipliers(reaction), Eigen::Vector2d(2, -3 * 2 + 4));
  EXPECT_FALSE(reduction.moves(reduction.dependents()[0]));
  EXPECT_TRUE(reduction.moves(reduction.dependents()[1]));
}

TEST(Multipliers, AreOfEquationsWhoseRightSidesVary) {
  const Reduction reduction(2, {}, {{1, {{0, 1}}, {}, {{0, 1}}}}, {{5, ramp}});
  EXPECT_TRUE(reduction.moves(reduction.dependents()[0]));
}

TEST(CarriedReduction, HasOfDisplacementsRelativeToItsBaseWhatItHadOfAll) {
  const auto reduction = carried();
  const double t = 3;
  VectorXd u = VectorXd::Zero(6);
  u[1] = 1;
  u[2] = 0.25;
  u[5] = -2;
  reduction.impose(t, u);
  VectorXd relative = u;
  for (const int node : {0, 1, 2}) {
    relative[2 * node] -= 2 * t;
    relative[2 * node + 1] -= t * t;
  }
  EXPECT_NEAR(relative[0], 0.5, 1e-14);
  EXPECT_NEAR(relative[3], relative[5], 1e-14);
  EXPECT_NEAR(relative[4], 2 * relative[2] + relative[0], 1e-14);
  EXPECT_LE((reduction.correction(t, u)).lpNorm<Eigen::Infinity>(), 1e-14);
  EXPECT_TRUE(reduction.moves(reduction.prescribed()[0]));
}

/// Velocities of the base that is given by them; the other one says nothing of its rates.
TEST(CarriedReduction, GivesRatesThatAreGiven) {
  const auto reduction = carried();
  VectorXd v = VectorXd::Zero(6);
  v[5] = 1;
  reduction.impose_rates(1, 3, v);
  EXPECT_EQ(v[0], 0);
  EXPECT_EQ(v[4], 0);
  EXPECT_EQ(v[5], 1);
  EXPECT_EQ(v[3], 0); // nothing is given beside what free dofs have: relate() puts it
  reduction.relate(v);
  EXPECT_EQ(v[3], 1);
}

} // namespace
} // namespace rubato::constraint::reduction_test
