// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/conjugate_gradients.hpp"
#include "rubato/linalg/iterative_solver.hpp"
#include "rubato/linalg/split_factor.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "unit/linalg/elastic_block.hpp"
#include "unit/linalg/matrices_beside.hpp"
#include "unit/linalg/random_vector.hpp"
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace rubato::linalg::iterative_solver_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::beside;
using test::random_vector;

constexpr auto plenty = std::numeric_limits<std::size_t>::max();

/// Of a block of nx × ny × nz cubes without the nodes at x = 0.
NodalUnknowns unknowns_of(int nx, int ny, int nz) {
  NodalUnknowns unknowns{3, {}, {}};
  std::vector<Eigen::Vector3d> places;
  for (int i = 1; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j)
      for (int k = 0; k <= nz; ++k)
        places.emplace_back(i, j, k);
  unknowns.dofs.resize(3 * places.size());
  std::iota(unknowns.dofs.begin(), unknowns.dofs.end(), 0);
  unknowns.rigid.resize(static_cast<Index>(unknowns.dofs.size()), 6);
  for (std::size_t node = 0; node < places.size(); ++node)
    for (Index axis = 0; axis < 3; ++axis) {
      const auto first = 3 * static_cast<Index>(node);
      unknowns.rigid.block<3, 1>(first, axis) = Eigen::Vector3d::Unit(axis);
      unknowns.rigid.block<3, 1>(first, 3 + axis) = Eigen::Vector3d::Unit(axis).cross(places[node]);
    }
  return unknowns;
}

/// Without the unknowns that are not chosen.
SparseMatrix part_of(const SparseMatrix& matrix, const std::vector<int>& chosen) {
  SparseMatrix pick(static_cast<Index>(chosen.size()), matrix.cols());
  for (std::size_t i = 0; i < chosen.size(); ++i)
    pick.insert(static_cast<int>(i), chosen[i]) = 1;
  return pick * matrix * SparseMatrix(pick.transpose());
}

NodalUnknowns part_of(const NodalUnknowns& unknowns, const std::vector<int>& chosen) {
  NodalUnknowns part{unknowns.components, {}, unknowns.rigid(chosen, Eigen::all)};
  for (const int i : chosen)
    part.dofs.push_back(unknowns.dofs[static_cast<std::size_t>(i)]);
  return part;
}

class IterativeSolverTest : public testing::Test {
protected:
  void SetUp() override {
    if (!has_conjugate_gradients())
      GTEST_SKIP() << "rubato is built without PETSc";
    factor = SplitFactor::of(matrix, surface, plenty);
    solver = IterativeSolver::of(matrix, surface, unknowns);
    ASSERT_TRUE(factor && solver);
  }

  /// By position of the factor: where the solver has it.
  std::vector<int> positions() const {
    std::vector<int> of_solver;
    for (const int unknown : factor->surface())
      of_solver.push_back(
          static_cast<int>(std::ranges::find(solver->surface(), unknown) - solver->surface().begin()));
    return of_solver;
  }

  void expect_near(const VectorXd& found, const VectorXd& expected, double part = 1e-9) const {
    EXPECT_LE((found - expected).norm(), part * expected.norm());
  }

  /// A block that is solved for by iterations, and a small one that is factored.
  SparseMatrix matrix = beside(test::elastic_block(12, 4, 4), test::elastic_block(3, 2, 2));
  std::vector<int> surface{2, 5, 700, 701, 702, static_cast<int>(matrix.cols()) - 1};
  NodalUnknowns unknowns = [] {
    const auto a = unknowns_of(12, 4, 4), b = unknowns_of(3, 2, 2);
    NodalUnknowns both{3, a.dofs, MatrixXd(a.rigid.rows() + b.rigid.rows(), 6)};
    both.rigid << a.rigid, b.rigid;
    for (const int dof : b.dofs)
      both.dofs.push_back(static_cast<int>(a.dofs.size()) + dof);
    return both;
  }();
  std::optional<SplitFactor> factor;
  std::unique_ptr<IterativeSolver> solver;
};

TEST_F(IterativeSolverTest, SolvesAsAFactorDoes) {
  const auto right_side = random_vector(matrix.rows(), 1);
  expect_near(solver->solve(right_side), factor->solve(right_side));
  EXPECT_EQ(solver->solve(VectorXd::Zero(matrix.rows())), VectorXd::Zero(matrix.rows()));
  EXPECT_THROW(solver->solve(VectorXd::Zero(1)), std::invalid_argument);
}

TEST_F(IterativeSolverTest, TakesFewIterationsByRigidMotions) {
  solver->solve(random_vector(matrix.rows(), 1));
  EXPECT_EQ(solver->count().solves, 1U) << "the small block has a factor";
  const auto many = IterativeSolver::of(matrix, surface, {3, unknowns.dofs, unknowns.rigid.leftCols(1)});
  many->solve(random_vector(matrix.rows(), 1));
  EXPECT_LT(solver->count().iterations, 30U);
  EXPECT_LT(solver->count().iterations, many->count().iterations);
}

TEST_F(IterativeSolverTest, KnowsTheSurfaceHalfWayAndTakesForcesThere) {
  const auto right_side = random_vector(matrix.rows(), 2);
  auto half_way = solver->forward(right_side);
  expect_near(solver->surface_of(half_way), factor->solve(right_side)(solver->surface()));
  const auto force = random_vector(static_cast<Index>(surface.size()), 3);
  solver->load_surface(force, half_way);
  VectorXd all = right_side;
  for (std::size_t i = 0; i < surface.size(); ++i)
    all[solver->surface()[i]] += force[static_cast<Index>(i)];
  expect_near(solver->backward(half_way), factor->solve(all));
}

TEST_F(IterativeSolverTest, GivesColumnsOfTheCompliance) {
  ASSERT_EQ(solver->body_starts(), factor->body_starts());
  auto of_body = positions();
  of_body.resize(5);
  const MatrixXd expected = factor->compliance(0);
  const MatrixXd found = solver->compliance(0)(of_body, of_body);
  EXPECT_LE((found - expected).norm(), 1e-9 * expected.norm());
  expect_near(solver->compliance(0, 3, 2).col(1), solver->compliance(0).col(4), 1e-14);
  const auto force = random_vector(5, 4);
  expect_near(solver->moved_by(0, force), solver->compliance(0) * force);
}

TEST_F(IterativeSolverTest, SolvesWithAnotherMatrixAsIfItHadBeenTheFirst) {
  const auto before = solver->renewals(0);
  ASSERT_TRUE(solver->refactor(matrix));
  EXPECT_EQ(solver->renewals(0), before) << "its values are the same";
  SparseMatrix other = matrix;
  other.diagonal().head(900) *= 1.5;
  ASSERT_TRUE(solver->refactor(other));
  EXPECT_EQ(solver->renewals(0), before + 1);
  EXPECT_EQ(solver->renewals(1), 1U) << "of the small block they are the same";
  const auto right_side = random_vector(matrix.rows(), 5);
  EXPECT_EQ(solver->solve(right_side), IterativeSolver::of(other, surface, unknowns)->solve(right_side))
      << "bit for bit";
  expect_near(solver->solve(right_side), SplitFactor::of(other, surface, plenty)->solve(right_side));
  EXPECT_THROW(solver->refactor(part_of(matrix, {0, 1, 2})), std::invalid_argument);
}

TEST_F(IterativeSolverTest, KnowsMatricesThatAreNotPositiveDefinite) {
  EXPECT_EQ(IterativeSolver::of(-1 * matrix, surface, unknowns), nullptr);
  SparseMatrix softened = matrix;
  for (int unknown = 0; unknown < matrix.cols(); ++unknown)
    softened.coeffRef(unknown, unknown) -= 0.05 * matrix.coeff(unknown, unknown);
  ASSERT_FALSE(SplitFactor::of(softened, surface, plenty));
  EXPECT_FALSE(solver->refactor(softened));
  EXPECT_FALSE(solver->has_values());
  EXPECT_THROW(solver->solve(VectorXd::Ones(matrix.rows())), std::logic_error);
  ASSERT_TRUE(solver->refactor(matrix));
  SparseMatrix broken = matrix;
  broken.coeffRef(7, 7) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver->refactor(broken));
}

/// Symmetry planes, hinges: nodes lack some of their unknowns.
TEST_F(IterativeSolverTest, TakesNodesThatLackUnknowns) {
  std::vector<int> chosen;
  for (int i = 0; i < matrix.cols(); ++i)
    if (i % 15 != 2 && i % 37 != 0)
      chosen.push_back(i);
  const auto part = part_of(matrix, chosen);
  const auto of_part = IterativeSolver::of(part, std::vector{0, 1}, part_of(unknowns, chosen));
  ASSERT_TRUE(of_part);
  const auto right_side = random_vector(part.rows(), 6);
  expect_near(of_part->solve(right_side), SplitFactor::of(part, {}, plenty)->solve(right_side));
  EXPECT_LT(of_part->count().iterations, 40U);
}

TEST_F(IterativeSolverTest, SaysThatItDidNotConverge) {
  IterativeSettings settings;
  settings.most_iterations = 1;
  EXPECT_THROW(IterativeSolver::of(
                   matrix, surface, unknowns, [](std::size_t) {}, settings),
               NotSolved);
}

TEST_F(IterativeSolverTest, TellsWhatItNeedsBeforeItSetsAnythingUp) {
  std::size_t told = 0;
  EXPECT_THROW(IterativeSolver::of(matrix, surface, unknowns,
                                   [&](std::size_t bytes) {
                                     told = bytes;
                                     throw std::runtime_error("too much");
                                   }),
               std::runtime_error);
  EXPECT_EQ(told, solver->factor_bytes());
  EXPECT_GT(told, 12 * static_cast<std::size_t>(matrix.nonZeros()));
}

TEST_F(IterativeSolverTest, WantsADofOfEveryUnknown) {
  EXPECT_THROW(IterativeSolver::of(matrix, surface, {3, {0, 1, 2}, unknowns.rigid}), std::invalid_argument);
  EXPECT_THROW(IterativeSolver::of(SparseMatrix(2, 3), {}, unknowns), std::invalid_argument);
}

} // namespace
} // namespace rubato::linalg::iterative_solver_test
