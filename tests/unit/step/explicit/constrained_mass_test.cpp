// SPDX-License-Identifier: LGPL-3.0-or-later
/// Masses on the unknowns of a made-up reduction against dense matrices.
#include "rubato/constraint/reduction.hpp"
#include "rubato/step/explicit/constrained_mass.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include <vector>

namespace rubato::step::constrained_mass_test {
namespace {

using constraint::Reduction;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int dof_count = 8;

/// Dof 0 is prescribed, 3 and 6 depend on others, 7 on nothing unknown.
Reduction some_reduction() {
  return {dof_count,
          {{0, 0.5, {}}},
          {{3, {{1, 2}, {4, -0.5}}, {}, {}}, {6, {{4, 1}}, {{0, 3}}, {}}, {7, {}, {{0, 1}}, {}}},
          {}};
}

MatrixXd t_of(const Reduction& reduction) {
  MatrixXd t(dof_count, reduction.unknown_count());
  for (Index i = 0; i < t.cols(); ++i)
    t.col(i) = reduction.scatter(VectorXd::Unit(t.cols(), i));
  return t;
}

const VectorXd lumped = VectorXd::LinSpaced(dof_count, 1, 4);
const VectorXd force = VectorXd::LinSpaced(dof_count, -2, 3);

/// Masses m wᵀw of a reference that follows dofs 2 and 3.
linalg::SparseMatrix attached() {
  linalg::SparseMatrix matrix(dof_count, dof_count);
  for (const int i : {2, 3})
    for (const int j : {2, 3})
      matrix.insert(i, j) = 0.7 * (i == 2 ? 1 : -2) * (j == 2 ? 1 : -2);
  return matrix;
}

VectorXd dense_response(const Reduction& reduction, const MatrixXd& mass) {
  const auto t = t_of(reduction);
  return t * test::inverse(t.transpose() * mass * t) * t.transpose() * force;
}

TEST(ConstrainedMass, RespondsOnWhatRelationsCouple) {
  const auto reduction = some_reduction();
  const ConstrainedMass mass(lumped, {}, reduction);
  EXPECT_EQ(mass.coupled(), (std::vector<int>{1, 4}));
  VectorXd motion = VectorXd::Constant(dof_count, 9);
  mass.respond(force, motion);
  const auto expected = dense_response(reduction, lumped.asDiagonal());
  for (const int dof : {1, 3, 4, 6})
    EXPECT_NEAR(motion[dof], expected[dof], 1e-14) << dof;
  for (const int dof : {0, 2, 5, 7})
    EXPECT_EQ(motion[dof], 9) << dof;
}

TEST(ConstrainedMass, HasAttachedMasses) {
  const auto reduction = some_reduction();
  const ConstrainedMass mass(lumped, attached(), reduction);
  const MatrixXd whole = MatrixXd(lumped.asDiagonal()) + MatrixXd(attached());
  EXPECT_EQ(mass.coupled(), (std::vector<int>{1, 2, 4}));
  VectorXd motion = VectorXd::Zero(dof_count);
  mass.respond(force, motion);
  const auto expected = dense_response(reduction, whole);
  for (const int dof : {1, 2, 3, 4, 6})
    EXPECT_NEAR(motion[dof], expected[dof], 1e-14) << dof;
  EXPECT_LT((mass.times(force) - whole * force).norm(), 1e-14);
  EXPECT_NEAR(mass.attached_product(force, lumped), force.dot(attached() * lumped), 1e-14);
}

TEST(ConstrainedMass, ProjectsOnMotionsThatRelationsAdmit) {
  const auto reduction = some_reduction();
  const ConstrainedMass mass(lumped, {}, reduction);
  VectorXd admitted = force;
  mass.admit(admitted);
  EXPECT_NEAR(admitted[3], 2 * admitted[1] - 0.5 * admitted[4], 1e-14);
  EXPECT_NEAR(admitted[6], admitted[4], 1e-14);
  VectorXd again = admitted;
  mass.admit(again);
  EXPECT_LT((again - admitted).norm(), 1e-14);
  const VectorXd other = lumped.cwiseProduct(force).reverse();
  VectorXd forces = other;
  mass.admit_forces(forces);
  EXPECT_NEAR(forces.dot(force), other.dot(admitted), 1e-13) << "the transpose";
}

TEST(ConstrainedMass, CouplesNothingWithoutRelations) {
  const ConstrainedMass mass(lumped, {}, Reduction(dof_count, {}));
  EXPECT_FALSE(mass.couples());
  VectorXd motion = force;
  mass.respond(force, motion);
  EXPECT_EQ(motion, force);
}

} // namespace
} // namespace rubato::step::constrained_mass_test
