// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs and dashpots along the current line between two places: derivatives against finite differences,
// works against closed forms, turned problems.
#include "rubato/domain/line_springs.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

namespace rubato::domain::line_springs_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Case {
  std::string name;
  int components = 2;
  LineLaw spring;
  LineLaw dashpot;
};

/// How failures print it.
void PrintTo(const Case& wanted, std::ostream* out) {
  *out << wanted.name;
}

/// From a node to a place between two nodes, as those of a cell are.
LineSpring spring_of(const Case& wanted) {
  const int d = wanted.components;
  LineSpring spring;
  spring.undeformed = d == 2 ? Vector3d(0.6, -0.8, 0) : Vector3d(0.6, -0.8, 1.1);
  spring.rows = Eigen::Matrix3Xd::Zero(3, Index{3} * d);
  for (int node = 0; node < 3; ++node)
    for (int a = 0; a < d; ++a) {
      spring.dofs.push_back(node * d + a);
      spring.rows(a, Index{node} * d + a) = node == 0 ? -1 : node == 1 ? 0.3 : 0.7;
    }
  spring.spring = wanted.spring;
  spring.dashpot = wanted.dashpot;
  return spring;
}

VectorXd numbers(Index size, double size_of_one, double start) {
  VectorXd x(size);
  for (Index i = 0; i < size; ++i)
    x[i] = size_of_one * std::sin(start + 2.3 * static_cast<double>(i));
  return x;
}

SparseMatrix full_pattern(Index size) {
  SparseMatrix matrix = MatrixXd::Ones(size, size).sparseView();
  matrix.coeffs().setZero();
  return matrix;
}

class LineSprings : public testing::TestWithParam<Case> {
protected:
  const LineSpring spring = spring_of(GetParam());
  const std::vector<LineSpring> springs{spring};
  const Index size = static_cast<Index>(spring.dofs.size());
  const VectorXd u0 = numbers(size, 0.2, 1), u1 = numbers(size, 0.3, 2), v = numbers(size, 4, 3);

  VectorXd forces(const VectorXd& u, ForcesOf of) const {
    VectorXd sum = VectorXd::Zero(size);
    add_line_forces(springs, {.u0 = u0, .u1 = u, .of = of}, sum);
    return sum;
  }
  MatrixXd tangent(ForcesOf of, TangentOf kind) const {
    auto matrix = full_pattern(size);
    add_line_tangents(springs, {.u0 = u0, .u1 = u1, .of = of}, kind, matrix);
    return matrix;
  }
  /// Central differences of a vector.
  template <class F> MatrixXd differences(const VectorXd& at, const F& f) const {
    constexpr double h = 1e-6;
    MatrixXd result(size, size);
    for (Index j = 0; j < size; ++j) {
      VectorXd up = at, down = at;
      up[j] += h;
      down[j] -= h;
      result.col(j) = (f(up) - f(down)) / (2 * h);
    }
    return result;
  }
};

TEST_P(LineSprings, HaveTheDerivativesOfTheirForces) {
  const auto at_end = differences(u1, [&](const VectorXd& u) { return forces(u, ForcesOf::end); });
  const double scale = at_end.norm();
  ASSERT_GT(scale, 1);
  EXPECT_LE((tangent(ForcesOf::end, TangentOf::symmetric) - at_end).norm(), 1e-7 * scale);
  const auto of_step = differences(u1, [&](const VectorXd& u) { return forces(u, ForcesOf::step); });
  EXPECT_LE((tangent(ForcesOf::step, TangentOf::exact) - 2 * of_step).norm(), 1e-7 * scale);
  const MatrixXd symmetric = of_step + of_step.transpose();
  EXPECT_LE((tangent(ForcesOf::step, TangentOf::symmetric) - symmetric).norm(), 1e-7 * scale);
}

TEST_P(LineSprings, HaveForcesOfTheirEnergyAndConserveIt) {
  constexpr double h = 1e-6;
  const VectorXd f = forces(u1, ForcesOf::end);
  for (Index j = 0; j < size; ++j) {
    VectorXd up = u1, down = u1;
    up[j] += h;
    down[j] -= h;
    EXPECT_NEAR((line_energy(springs, up) - line_energy(springs, down)) / (2 * h), f[j], 1e-7 * f.norm());
  }
  const double stored = line_energy(springs, u1) - line_energy(springs, u0);
  const VectorXd moved = u1 - u0;
  const double scale = std::abs(line_energy(springs, u1)) + std::abs(line_energy(springs, u0));
  EXPECT_NEAR(forces(u1, ForcesOf::step).dot(moved), stored, 1e-14 * scale);
  const double by_ends = 0.5 * moved.dot(forces(u0, ForcesOf::end) + forces(u1, ForcesOf::end));
  EXPECT_NEAR(missed_along_lines(springs, u0, u1), by_ends - stored, 1e-14 * scale);
}

TEST_P(LineSprings, HaveTheDerivativesOfTheirDamping) {
  if (!has_dashpots(springs))
    GTEST_SKIP() << "no dashpot";
  const auto force = [&](const VectorXd& u, const VectorXd& rate) {
    VectorXd sum = VectorXd::Zero(size);
    add_line_damping(springs, u, rate, sum);
    return sum;
  };
  const auto by_v = differences(v, [&](const VectorXd& rate) { return force(u1, rate); });
  const auto by_u = differences(u1, [&](const VectorXd& u) { return force(u, v); });
  auto matrix = full_pattern(size);
  add_line_damping_tangents(springs, u1, v, {.by_velocity = 2, .by_displacement = 3}, matrix);
  const MatrixXd expected = 2 * by_v + 1.5 * (by_u + by_u.transpose());
  EXPECT_LE((MatrixXd(matrix) - expected).norm(), 1e-7 * expected.norm());
  EXPECT_GE(force(u1, v).dot(v), 0);
}

/// All places, displacements and velocities turned by one rotation.
TEST_P(LineSprings, TurnWithTheProblem) {
  const int d = GetParam().components;
  const Matrix3d turn = (d == 2 ? Eigen::AngleAxisd(2.1, Vector3d::UnitZ())
                                : Eigen::AngleAxisd(2.1, Vector3d(1, 2, -3).normalized()))
                            .toRotationMatrix();
  auto turned = springs;
  turned[0].undeformed = turn * spring.undeformed;
  const auto turned_dofs = [&](const VectorXd& x) {
    VectorXd y(size);
    for (Index node = 0; node < 3; ++node)
      y.segment(node * d, d) = turn.topLeftCorner(d, d) * x.segment(node * d, d);
    return y;
  };
  const VectorXd w0 = turned_dofs(u0), w1 = turned_dofs(u1);
  for (const auto of : {ForcesOf::end, ForcesOf::step}) {
    VectorXd f = VectorXd::Zero(size);
    add_line_forces(turned, {.u0 = w0, .u1 = w1, .of = of}, f);
    EXPECT_LE((f - turned_dofs(forces(u1, of))).norm(), 1e-13 * f.norm());
  }
  EXPECT_NEAR(line_energy(turned, w1), line_energy(springs, u1), 1e-13 * line_energy(springs, u1));
}

const LinearTable progressive{{-0.4, 0, 0.1, 0.5}, {-90, 20, 30, 200}, LinearTable::Outside::linear};
const LinearTable absorber{{-3, -1, 1, 3}, {-30, -20, 20, 25}, LinearTable::Outside::linear};

INSTANTIATE_TEST_SUITE_P(Laws, LineSprings,
                         testing::Values(Case{"Plane", 2, {300}, {20}}, Case{"Space", 3, {300}, {20}},
                                         Case{"PlaneByTables", 2, {0, progressive}, {0, absorber}},
                                         Case{"SpaceByTables", 3, {0, progressive}, {0, absorber}}),
                         [](const auto& info) { return info.param.name; });

/// 1e-9 of the length: a difference of two lengths would leave seven digits.
TEST(LineSpring, HasTheElongationOfSmallDisplacementsToRounding) {
  const std::vector<LineSpring> springs{spring_of({"", 2, {300}, {}})};
  VectorXd u = VectorXd::Zero(6);
  const Vector3d n = springs[0].undeformed.normalized();
  const double e = 1e-9;
  for (Index a = 0; a < 2; ++a)
    u[2 + a] = u[4 + a] = e * n[a];
  VectorXd f = VectorXd::Zero(6);
  add_line_forces(springs, {u, u}, f);
  EXPECT_NEAR(f.head<2>().norm(), 300 * e, 1e-14 * 300 * e);
}

/// Straight through the other end, or next to it.
TEST(LineSpring, FailsWhereItsEndsComeTogether) {
  const std::vector<LineSpring> springs{spring_of({"", 2, {300}, {}})};
  const VectorXd u0 = VectorXd::Zero(6);
  VectorXd u1 = u0;
  u1.head<2>() = 1.5 * springs[0].undeformed.head<2>();
  const auto failed = find_without_length(springs, {u0, u1});
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->reason, element::Failure::no_length);
  u1[0] += 0.1;
  EXPECT_FALSE(find_without_length(springs, {u0, u1}));
}

} // namespace
} // namespace rubato::domain::line_springs_test
