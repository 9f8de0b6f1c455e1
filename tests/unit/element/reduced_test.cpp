// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells of one point; what they share with the others is tested beside these (nonlinear_test.cpp).
#include "rubato/element/nonlinear/hourglass_control.hpp"
#include "rubato/element/nonlinear/mean_gradients.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "kind_cases.hpp"
#include "point_test_laws.hpp"
#include "support/dense.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::element::reduced_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;
using test::ElasticLaw;
using test::PlaneStressLaw;

const ElasticLaw steel{200., 0.3};
const PlaneStressLaw<ElasticLaw> flat_steel{steel};

struct Family {
  CellType type;
  Physics physics;
  int rigid;  ///< motions without strain
  int unseen; ///< and those that one point does not see
};
/// A point sees 6 of 24 motions, 3 of 8 or, axisymmetric, 4 of 8.
const std::vector<Family> families{{CellType::hexa8, Physics::solid, 6, 18},
                                   {CellType::quad4, Physics::plane_strain, 3, 5},
                                   {CellType::quad4, Physics::plane_stress, 3, 5},
                                   {CellType::quad4, Physics::axisymmetric, 1, 4}};

OneCell reduced_cell(const Family& family, StrainKind strain = StrainKind::small,
                     HourglassControl control = {}) {
  return {{family.type, {family.physics, 1}, strain, Formulation::reduced, control},
          family.physics == Physics::plane_stress ? PointLaws(flat_steel) : PointLaws(steel)};
}

Eigen::Index motions_without_stiffness(OneCell cell) {
  EXPECT_TRUE(cell.evaluate(VectorXd::Zero(cell.dofs)));
  const VectorXd values = test::symmetric_eigenvalues(cell.tangent);
  return (values.array().abs() < 1e-12 * values.maxCoeff()).count();
}

TEST(ReducedCells, ResistAllButRigidMotions) {
  for (const auto& family : families) {
    EXPECT_EQ(motions_without_stiffness(reduced_cell(family)), family.unseen);
    EXPECT_EQ(motions_without_stiffness(reduced_cell(family, StrainKind::small, {steel.shear()})),
              family.rigid);
  }
}

TEST(ReducedCells, HaveTheMeansOfTheGradientsOfDistortedCells) {
  const auto points = test::bent_cell(CellType::hexa8);
  const CellGradients at_points(CellType::hexa8, points, {}, PointRule::stiffness),
      means(CellType::hexa8, points, {}, PointRule::one);
  double volume = 0, error = 0, size = 0;
  for (int q = 0; q < 8; ++q)
    volume += at_points.weight(q);
  EXPECT_NEAR(means.weight(0), volume, 1e-14);
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i < 8; ++i) {
      double sum = 0;
      for (int q = 0; q < 8; ++q)
        sum += at_points.weight(q) * at_points.at(q, row, i);
      error = std::max(error, std::abs(means.at(0, row, i) - sum / volume));
      size = std::max(size, std::abs(means.at(0, row, i)));
    }
  EXPECT_LT(error, 1e-14 * size);
}

/// The transforms of the waves have the signs of cell::shortest_waves.
TEST(ReducedCells, HaveSumsOfWaves) {
  const auto points = test::bent_cell(CellType::hexa8);
  const auto sums = wave_sums<3>(points);
  for (std::size_t w = 1; w < sums.size(); ++w)
    for (int a = 0; a < 3; ++a) {
      double sum = 0;
      for (std::size_t i = 0; i < points.size(); ++i)
        sum += waves<3>().of(static_cast<int>(w) - 1)[i] * points[i][a];
      EXPECT_NEAR(sums[w][static_cast<std::size_t>(a)], sum, 1e-14);
    }
}

TEST(ReducedCells, GiveNothingToHourglassesUnderLinearMapsOfAnySize) {
  Matrix3d h;
  h << 1.5, 0.7, -0.4, -0.3, -0.6, 0.8, 0.2, 0.9, 2;
  for (const auto& family : families) {
    auto map = h;
    if (family.physics == Physics::axisymmetric)
      map(0, 1) = 0; // u_r = c R
    auto cell = reduced_cell(family, StrainKind::green_lagrange, {steel.shear()});
    const auto result = cell.evaluate(cell.linear_field({family.rigid == 1 ? 0. : 3., -2, 1}, map));
    ASSERT_TRUE(result);
    EXPECT_LT(result.hourglass, 1e-28 * steel.young);
  }
}

/// Deformed cells are turned by a right angle after their deformation.
TEST(ReducedCells, TurnTheirForcesWithThem) {
  const Matrix3d turn = Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ()).toRotationMatrix();
  for (const auto& family : families)
    for (const auto strain : {StrainKind::green_lagrange, StrainKind::logarithmic})
      for (const double limit : {0., 0.01}) {
        if (family.physics == Physics::axisymmetric)
          continue;
        auto cell = reduced_cell(family, strain, {steel.shear(), limit});
        const VectorXd u = 5 * some_displacement(cell);
        const auto before = cell.evaluate(u);
        const VectorXd force = cell.force;
        VectorXd turned(cell.dofs), expected(cell.dofs);
        for (std::size_t i = 0; i < cell.points.size(); ++i) {
          const auto at = static_cast<Eigen::Index>(i) * cell.d;
          Vector3d moved = cell.points[i], pushed = Vector3d::Zero();
          moved.head(cell.d) += u.segment(at, cell.d);
          pushed.head(cell.d) = force.segment(at, cell.d);
          turned.segment(at, cell.d) = (turn * moved - cell.points[i]).head(cell.d);
          expected.segment(at, cell.d) = (turn * pushed).head(cell.d);
        }
        const auto after = cell.evaluate(turned);
        EXPECT_GT(before.hourglass, 0);
        EXPECT_NEAR(after.hourglass, before.hourglass, 1e-13 * before.hourglass);
        EXPECT_LT((cell.force - expected).norm(), 1e-12 * force.norm());
      }
}

/// u_x = a ξ η of a box: ½ E (2a/length)²/3 of its volume is the true energy of bending.
TEST(ReducedCells, BendWithThePartOfTheStiffnessThatIsSaid) {
  const ElasticLaw straight{200., 0.};
  const auto part_of = [&](CellType type, const Vector3d& sides) {
    OneCell cell({type,
                  {type == CellType::hexa8 ? Physics::solid : Physics::plane_strain, 1},
                  StrainKind::small,
                  Formulation::reduced,
                  {straight.shear()}},
                 PointLaws(straight));
    VectorXd u = VectorXd::Zero(cell.dofs);
    for (int i = 0; i < cell.dofs / cell.d; ++i) {
      const Vector3d xi = cell::reference_cell(type).nodes[static_cast<std::size_t>(i)];
      cell.points[static_cast<std::size_t>(i)] = xi.cwiseProduct(sides) / 2;
      u[i * cell.d] = 1e-3 * xi[0] * xi[1];
    }
    const auto result = cell.evaluate(u);
    EXPECT_LT(result.stored, 1e-20);
    const double volume = sides.head(cell.d).prod(), strain = 2e-3 / sides[0];
    return result.hourglass / (straight.young * strain * strain / 6 * volume);
  };
  EXPECT_NEAR(part_of(CellType::hexa8, {1, 1, 1}), 0.45, 1e-12);
  EXPECT_NEAR(part_of(CellType::quad4, {1, 1, 0}), 0.3, 1e-12);
  for (const double length : {0.1, 3., 10.}) {
    EXPECT_LT(part_of(CellType::hexa8, {length, 1, 1}), 1.4);
    EXPECT_LT(part_of(CellType::quad4, {length, 1, 0}), 0.6);
  }
}

/// e = 2√3 a of the displacement u_x = a ηζ of the unit cube.
TEST(ReducedCells, ResistWithAConstantStressBeyondTheLimit) {
  constexpr double limit = 1e-4;
  const double stiffness = hourglass_coefficient * steel.shear();
  auto cell = reduced_cell(families[0], StrainKind::small, {steel.shear(), limit});
  VectorXd shape = VectorXd::Zero(cell.dofs);
  for (int i = 0; i < 8; ++i) {
    const Vector3d xi = cell::reference_cell(CellType::hexa8).nodes[static_cast<std::size_t>(i)];
    cell.points[static_cast<std::size_t>(i)] = xi / 2;
    shape[3 * i] = xi[1] * xi[2];
  }
  const double strain = 2 * std::sqrt(3.);
  const auto weak = cell.evaluate(1e-8 * shape);
  EXPECT_NEAR(weak.hourglass, 0.5 * stiffness * std::pow(1e-8 * strain, 2), 1e-6 * weak.hourglass);
  for (const double amplitude : {0.1, 0.2}) {
    const auto strong = cell.evaluate(amplitude * shape);
    EXPECT_NEAR(strong.hourglass, stiffness * limit * (strain * amplitude - limit), 1e-3 * strong.hourglass);
    EXPECT_NEAR(cell.force.dot(shape), stiffness * limit * strain, 1e-3 * stiffness * limit * strain);
  }
}

} // namespace
} // namespace rubato::element::reduced_test
