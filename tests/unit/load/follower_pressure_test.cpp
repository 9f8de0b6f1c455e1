// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/shape_table.hpp"
#include "rubato/domain/block_pattern.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/load/field_forces.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/load/nodal_forces.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "distorted_body.hpp"
#include <numbers>
#include <random>
#include <stdexcept>

namespace rubato::load::follower_pressure_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;

FieldFunction uniform(double pressure) {
  return {.number = pressure, .expression = {}, .function = {}};
}
FieldFunction formula(const std::string& text) {
  return {.expression = Expression(text), .function = {}};
}

/// Along one dof, by central differences.
template <class F> auto slope(const F& f, const VectorXd& u, Index dof) {
  constexpr double step = 1e-5;
  VectorXd moved = u;
  moved[dof] = u[dof] + step;
  auto rise = f(moved);
  moved[dof] = u[dof] - step;
  rise -= f(moved);
  rise /= 2 * step;
  return rise;
}

/// Under displacements that warp every face.
class EveryBodyUnderFollowers : public DistortedBody {
protected:
  std::vector<Face> faces() const {
    std::vector<Face> faces;
    for (const auto& side : sides_)
      faces.push_back({side.type, side.nodes});
    return faces;
  }
  FollowerPressure follower(const FieldFunction& pressure) const {
    return make_follower_pressure(mesh_, dofs_, section_, faces(), pressure);
  }
  VectorXd none() const { return VectorXd::Zero(dofs_.dof_count); }
  VectorXd warped() const {
    std::mt19937 engine(7);
    VectorXd u = none();
    for (auto& value : u)
      value = 0.1 * (static_cast<double>(engine() % 2001) / 1000. - 1.);
    return u;
  }
  VectorXd force(const FollowerPressure& load, const VectorXd& u, double t) const {
    VectorXd force = none();
    add_follower_force(load, u, t, force);
    return force;
  }
  /// −∂f/∂u by central differences.
  MatrixXd stiffness_by_differences(const FollowerPressure& load, const VectorXd& u, double t) const {
    MatrixXd k(u.size(), u.size());
    for (Index dof = 0; dof < u.size(); ++dof)
      k.col(dof) = -slope([&](const VectorXd& at) { return force(load, at, t); }, u, dof);
    return k;
  }
  /// Of all faces together.
  MatrixXd exact_stiffness(const FollowerPressure& load, const VectorXd& u, double t) const {
    MatrixXd k = MatrixXd::Zero(u.size(), u.size());
    for (const auto& face : load.faces) {
      const auto of_face = stiffness_of(load, face, u, t);
      for (std::size_t i = 0; i < face.dofs.size(); ++i)
        for (std::size_t j = 0; j < face.dofs.size(); ++j)
          k.block(face.dofs[i], face.dofs[j], d_, d_) +=
              of_face.block(static_cast<Index>(i) * d_, static_cast<Index>(j) * d_, d_, d_);
    }
    return k;
  }
  /// Of the deformed body.
  double volume(const VectorXd& u) const {
    double sum = 0;
    const auto& block = mesh_.blocks.front();
    const auto& table = cell::mass_table(block.type);
    for (Index q = 0; q < table.weights.size(); ++q)
      for (mesh::CellIndex c = 0; c < block.cell_count(); ++c)
        sum += table.weights[q] * volume_at(table, q, block.cell(c), u);
    return sum;
  }

private:
  double volume_at(const cell::ShapeTable& table, Index q, std::span<const mesh::NodeIndex> nodes,
                   const VectorXd& u) const {
    MatrixXd jacobian = MatrixXd::Zero(d_, d_);
    double radius = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto i = static_cast<Index>(n);
      const VectorXd x =
          mesh_.points[static_cast<std::size_t>(nodes[n])].head(d_) + u.segment(dofs_.dof(nodes[n], 0), d_);
      jacobian += x * table.gradients.col(q).segment(i * d_, d_).transpose();
      radius += table.values(i, q) * x[0];
    }
    return element::measure(section_, radius) * jacobian.determinant();
  }
};

TEST_P(EveryBodyUnderFollowers, HaveTheForcesOfADeadPressureWhereNothingIsDisplaced) {
  VectorXd dead = none();
  add_pressure(mesh_, dofs_, section_, faces(), 3, dead);
  EXPECT_LE((force(follower(uniform(3)), none(), 0) - dead).norm(), 1e-14 * dead.norm());

  auto changing = formula("(1+x*y)*t");
  changing.function = Function{{0, 4}, {0, 1}};
  FieldForce field{changing, {}};
  visit_pressure(mesh_, dofs_, section_, faces(), [&](const auto& at) { field.places.push_back(at); });
  dead.setZero();
  add_field_force(field, 2, dead);
  EXPECT_LE((force(follower(changing), none(), 2) - dead).norm(), 1e-14 * dead.norm());
}

/// 0.5 (1 + 2 x) at t = 1, whether the expression has t or a function.
TEST_P(EveryBodyUnderFollowers, HavePressuresOfUndeformedPlacesHoweverTheyChangeWithTime) {
  auto by_function = formula("1+2*x");
  by_function.function = Function{{0, 2}, {0, 1}};
  const auto by_expression = formula("(1+2*x)*t/2");
  const VectorXd expected = force(follower(formula("0.5+x")), warped(), 1);
  EXPECT_LE((force(follower(by_function), warped(), 1) - expected).norm(), 1e-14 * expected.norm());
  EXPECT_LE((force(follower(by_expression), warped(), 1) - expected).norm(), 1e-14 * expected.norm());
}

TEST_P(EveryBodyUnderFollowers, HaveTheStiffnessOfDifferencesOnEachFace) {
  auto load = follower(formula("1+2*x-y"));
  const VectorXd u = warped();
  const auto all = load.faces;
  for (const auto& face : all) {
    load.faces = {face};
    const MatrixXd expected = stiffness_by_differences(load, u, 0);
    EXPECT_LE((exact_stiffness(load, u, 0) - expected).cwiseAbs().maxCoeff(),
              1e-8 * expected.cwiseAbs().maxCoeff());
  }
}

TEST_P(EveryBodyUnderFollowers, AddTheSymmetricPartToAStiffness) {
  const domain::BlockPattern pattern(mesh_, bulk_.cells, dofs_);
  auto matrix = pattern.zero_matrix();
  const auto before = matrix.nonZeros();
  auto load = follower(formula("1+2*x-y"));
  load.faces.resize(load.faces.size() / 2); // an open surface, whose stiffness is not symmetric
  load.value.function = Function{{0, 2}, {0, 1}};
  const MatrixXd exact = exact_stiffness(load, warped(), 1);
  ASSERT_GT((exact - exact.transpose()).norm(), 1e-2 * exact.norm());
  add_follower_tangent(load, warped(), 1, 3, matrix);
  const MatrixXd expected = 1.5 * (exact + exact.transpose());
  EXPECT_LE((MatrixXd(matrix) - expected).norm(), 1e-14 * expected.norm());
  EXPECT_EQ(matrix.nonZeros(), before);
}

/// A ring is pushed along its axis by no closed pressure, but outwards.
TEST_P(EveryBodyUnderFollowers, HaveNoResultantAllRound) {
  const VectorXd pushed = force(follower(uniform(3)), warped(), 0);
  for (int i = physics_ == Physics::axisymmetric ? 1 : 0; i < d_; ++i) {
    double sum = 0;
    for (const auto node : dofs_.nodes)
      sum += pushed[dofs_.dof(node, i)];
    EXPECT_NEAR(sum, 0, 1e-13 * pushed.cwiseAbs().sum());
  }
}

/// f = −p ∂V/∂u, so that p V is a potential and −∂f/∂u is symmetric. Volumes of pyramids are no polynomials,
/// which rules integrate nearly only.
TEST_P(EveryBodyUnderFollowers, LoseVolumeAllRoundBySymmetricForces) {
  const auto load = follower(uniform(3));
  const VectorXd u = warped();
  const MatrixXd k = exact_stiffness(load, u, 0);
  EXPECT_LE((k - k.transpose()).norm(), 1e-13 * k.norm());
  if (cell::topology(GetParam().type).corner_count == 5)
    return;
  const VectorXd pushed = force(load, u, 0);
  for (Index dof = 0; dof < u.size(); ++dof) {
    const double grown = slope([&](const VectorXd& at) { return volume(at); }, u, dof);
    EXPECT_NEAR(pushed[dof], -3 * grown, 1e-8);
  }
}

TEST_P(EveryBodyUnderFollowers, NeedTheirPlacesInTheMatrix) {
  domain::SparseMatrix diagonal(dofs_.dof_count, dofs_.dof_count);
  diagonal.setIdentity();
  EXPECT_THROW(add_follower_tangent(follower(uniform(3)), warped(), 0, 1, diagonal), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(Cells, EveryBodyUnderFollowers, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& instance) { return test::name_of(instance.param); });

/// A quarter of a turn of a unit square under 2 on its right side: the force turns along.
TEST(FollowerPressure, TurnsWithTheBody) {
  const auto mesh = test::patch_mesh(CellType::quad4, 1, [](const Vector3d& x) { return x; });
  const domain::DofMap dofs = domain::number_dofs(mesh, std::array<mesh::CellIndex, 1>{0}, 2);
  const std::array<mesh::NodeIndex, 2> right{1, 3};
  const element::Section section{Physics::plane_strain, 1};
  const std::array faces{Face{CellType::seg2, right}};
  const auto load = make_follower_pressure(mesh, dofs, section, faces, uniform(2));
  VectorXd u(8);
  for (int i = 0; i < 4; ++i) {
    const auto& x = mesh.points[static_cast<std::size_t>(i)];
    u.segment<2>(dofs.dof(i, 0)) = Eigen::Vector2d(-x[1] - x[0], x[0] - x[1]); // (x, y) to (−y, x)
  }
  VectorXd force = VectorXd::Zero(8);
  add_follower_force(load, u, 0, force);
  VectorXd expected = VectorXd::Zero(8);
  expected[dofs.dof(1, 1)] = expected[dofs.dof(3, 1)] = -1;
  EXPECT_LE((force - expected).norm(), 1e-15);
}

TEST(FollowerPressure, ActsOnSidesOnly) {
  const auto mesh = test::patch_mesh(CellType::quad4, 1, [](const Vector3d& x) { return x; });
  const domain::DofMap dofs = domain::number_dofs(mesh, std::array<mesh::CellIndex, 1>{0}, 2);
  const std::array faces{Face{CellType::quad4, mesh.nodes_of(0)}};
  EXPECT_THROW(make_follower_pressure(mesh, dofs, {Physics::plane_strain, 1}, faces, uniform(2)),
               std::invalid_argument);
}

} // namespace
} // namespace rubato::load::follower_pressure_test
