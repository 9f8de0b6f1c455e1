// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "kind_cases.hpp"
#include "point_test_laws.hpp"
#include "support/dense.hpp"
#include <numbers>
#include <stdexcept>

namespace rubato::element::nonlinear_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;
using test::ElasticLaw;
using test::NeoHookeanLaw;
using test::PlaneStressLaw;
using test::PlasticLaw;

const ElasticLaw elastic{210., 0.3};
const PlasticLaw plastic{elastic, 0.05, 5.};
const NeoHookeanLaw rubber{80., 250.};
const PlaneStressLaw<ElasticLaw> flat_elastic{elastic};
const PlaneStressLaw<PlasticLaw> flat_plastic{plastic};

bool is_flat(const CellKind& kind) {
  return kind.section.physics == Physics::plane_stress;
}

PointLaws elastic_for(const CellKind& kind) {
  return is_flat(kind) ? PointLaws(flat_elastic) : PointLaws(elastic);
}

/// A law that is not linear: J2 or, of Green–Lagrange's strain in space, neo-Hookean.
PointLaws curved_for(const CellKind& kind) {
  if (is_flat(kind))
    return PointLaws(flat_plastic);
  return kind.strain == StrainKind::green_lagrange ? PointLaws(rubber) : PointLaws(plastic);
}

PointLaws plastic_for(const CellKind& kind) {
  return is_flat(kind) ? PointLaws(flat_plastic) : PointLaws(plastic);
}

class EveryKind : public testing::TestWithParam<CellKind> {};

TEST_P(EveryKind, HasTheDerivativeOfItsForcesAsTangentWhenElastic) {
  OneCell cell(GetParam(), elastic_for(GetParam()));
  EXPECT_LT(error_of_tangent(cell), 1e-8);
}

TEST_P(EveryKind, HasTheDerivativeOfItsForcesAsTangentWhenTheLawIsCurved) {
  OneCell cell(GetParam(), curved_for(GetParam()));
  EXPECT_LT(error_of_tangent(cell), 1e-8);
}

TEST_P(EveryKind, HasTheDerivativeOfItsForcesAsTangentWhenItYields) {
  OneCell cell(GetParam(), plastic_for(GetParam()));
  EXPECT_LT(error_of_tangent(cell), 1e-8);
}

TEST_P(EveryKind, HasTheDerivativeOfItsEnergyAsForces) {
  constexpr double h = 1e-4;
  OneCell cell(GetParam(), elastic_for(GetParam()));
  const VectorXd u = some_displacement(cell);
  ASSERT_TRUE(cell.evaluate(u));
  const VectorXd force = cell.force;
  for (Eigen::Index j = 0; j < cell.dofs; ++j) {
    const auto energy_at = [&](double step) {
      VectorXd moved = u;
      moved[j] += step;
      const auto result = cell.evaluate(moved);
      return result.stored + result.hourglass;
    };
    const double near = energy_at(h) - energy_at(-h), far = energy_at(2 * h) - energy_at(-2 * h);
    EXPECT_NEAR((8 * near - far) / (12 * h), force[j], 1e-8 * force.cwiseAbs().maxCoeff());
  }
}

/// Σ w P_c:dH = f·du, but for what hourglasses take.
TEST_P(EveryKind, HasTheWorkOfItsForcesAtItsPoints) {
  constexpr double h = 1e-5;
  OneCell cell(GetParam(), curved_for(GetParam()));
  cell.kind.hourglass = {};
  const VectorXd u = some_displacement(cell), step = h * VectorXd::Random(cell.dofs);
  ASSERT_TRUE(cell.evaluate(u - step));
  const auto before = cell.records;
  ASSERT_TRUE(cell.evaluate(u + step));
  const auto after = cell.records;
  ASSERT_TRUE(cell.evaluate(u));
  double work = 0, size = 0;
  for (std::size_t q = 0; q < cell.records.size(); ++q) {
    const Matrix3d change = after[q].gradient - before[q].gradient;
    const double here = cell.records[q].volume * cell.records[q].piola.cwiseProduct(change).sum();
    work += here;
    size += std::abs(here);
  }
  EXPECT_NEAR(work, 2 * cell.force.dot(step), 1e-8 * size);
}

/// Returns how many motions of a single cell have no energy beside the rigid ones.
int unseen_motions(const CellKind& kind) {
  const bool is_axisymmetric = kind.section.physics == Physics::axisymmetric;
  if (kind.type == CellType::tria3 && is_axisymmetric)
    return 1; // one point sees four strains of six motions
  if (kind.formulation == Formulation::lower_order && cell::topology(kind.type).corner_count == 6)
    return kind.type == CellType::penta6 ? 1 : 0;   // the twist about the axis
  if (kind.formulation == Formulation::lower_order) // 12 and 48 strains at the points of 13 and 54 motions
    return kind.section.physics == Physics::solid ? 6 : is_axisymmetric ? 0 : 1;
  if (kind.formulation != Formulation::mean_dilatation)
    return 0;
  // u = 2 (b·x) x − x² b has no shears, and a change of volume that vanishes in the mean of one cell alone
  if (kind.type == CellType::tetra10)
    return 3;
  return kind.type == CellType::tria6 && is_axisymmetric ? 1 : 0;
}

TEST_P(EveryKind, HasNoMoreModesWithoutEnergyThanRigidOnes) {
  OneCell cell(GetParam(), elastic_for(GetParam()));
  ASSERT_TRUE(cell.evaluate(VectorXd::Zero(cell.dofs)));
  const auto values = test::symmetric_eigenvalues(cell.tangent);
  const auto none = (values.array().abs() < 1e-10 * values.maxCoeff()).count();
  const auto physics = GetParam().section.physics;
  const int rigid = physics == Physics::solid ? 6 : physics == Physics::axisymmetric ? 1 : 3;
  EXPECT_EQ(none, rigid + unseen_motions(GetParam()));
  EXPECT_GT(values.minCoeff(), -1e-12 * values.maxCoeff());
}

/// With this and the cell's rule any patch of distorted cells passes the patch test.
TEST_P(EveryKind, HasTheSameStressEverywhereUnderAConstantStrain) {
  for (const double poisson : {0.3, 0.4999}) {
    const ElasticLaw law{210., poisson};
    const PlaneStressLaw<ElasticLaw> flat{law};
    OneCell cell(GetParam(), is_flat(GetParam()) ? PointLaws(flat) : PointLaws(law));
    Matrix3d h;
    h << 1e-3, 2e-3, -1e-3, -3e-3, 2e-3, 1e-3, 2e-3, 0, -2e-3;
    if (GetParam().section.physics == Physics::axisymmetric)
      h(0, 1) = 0; // u_r = c r only, so that the hoop strain is constant
    if (GetParam().section.physics == Physics::axisymmetric && mode_count(GetParam()) > 0)
      h(1, 0) = 0; // the bubble deforms under a constant shear, which is not in equilibrium
    ASSERT_TRUE(cell.evaluate(cell.linear_field({0, 0.1, 0}, h)));
    const auto& first = cell.records.front();
    for (const auto& record : cell.records) {
      EXPECT_LT((record.piola - first.piola).norm(), 1e-10 * first.piola.norm());
      EXPECT_LT((record.gradient - first.gradient).norm(), 1e-12);
    }
    if (GetParam().formulation == Formulation::lower_order &&
        GetParam().section.physics != Physics::plane_strain && !is_flat(GetParam()))
      continue; // such rules do not integrate gradients of bent solids and rings exactly
    const VectorXd force = cell.force;
    CellKind full = GetParam();
    full.formulation = Formulation::full;
    OneCell plain(full, cell.laws);
    ASSERT_TRUE(plain.evaluate(cell.linear_field({0, 0.1, 0}, h)));
    EXPECT_LT((force - plain.force).norm(), 1e-10 * force.norm());
  }
}

TEST_P(EveryKind, GivesTheSameForcesWithoutATangent) {
  OneCell cell(GetParam(), curved_for(GetParam()));
  const VectorXd u = some_displacement(cell);
  ASSERT_TRUE(cell.evaluate(u));
  VectorXd force(cell.dofs);
  const auto size = static_cast<std::size_t>(cell.dofs);
  ASSERT_TRUE(evaluate(cell.kind, cell.laws, {cell.points, {u.data(), size}, cell.old, cell.step, cell.modes},
                       {cell.now, {force.data(), size}, {}}));
  EXPECT_LT((force - cell.force).norm(), 1e-14 * force.norm());
}

TEST_P(EveryKind, GivesTheSameAtItsPointsWithoutATangent) {
  OneCell cell(GetParam(), curved_for(GetParam()));
  if (cell.laws.is_hyperelastic())
    cell.free_strain.assign(cell.records.size(), material::Strain6::Zero());
  else
    cell.free_strain.assign(cell.records.size(), 0.003 * material::Strain6::Random());
  const VectorXd u = some_displacement(cell);
  const auto with = cell.evaluate(u);
  ASSERT_TRUE(with);
  std::vector<double> now(cell.now.size());
  std::vector<PointRecord> records(cell.records.size());
  VectorXd force(cell.dofs);
  const auto size = static_cast<std::size_t>(cell.dofs);
  const auto without =
      evaluate(cell.kind, cell.laws,
               {cell.points, {u.data(), size}, cell.old, cell.step, cell.modes, cell.free_strain},
               {now, {force.data(), size}, {}, records});
  ASSERT_TRUE(without);
  EXPECT_NEAR(without.stored, with.stored, 1e-13 * with.stored);
  for (std::size_t i = 0; i < now.size(); ++i)
    EXPECT_NEAR(now[i], cell.now[i], 1e-14);
  for (std::size_t q = 0; q < records.size(); ++q) {
    const auto& expected = cell.records[q];
    EXPECT_NEAR(records[q].volume, expected.volume, 1e-14 * expected.volume);
    EXPECT_NEAR(records[q].stored, expected.stored, 1e-13 * expected.stored);
    EXPECT_LT((records[q].strain - expected.strain).norm(), 1e-15);
    EXPECT_EQ(records[q].free, expected.free);
    EXPECT_LT((records[q].stress - expected.stress).norm(), 1e-13 * expected.stress.norm());
    EXPECT_LT((records[q].cauchy - expected.cauchy).norm(), 1e-13 * expected.cauchy.norm());
    EXPECT_LT((records[q].gradient - expected.gradient).norm(), 1e-15);
    EXPECT_LT((records[q].piola - expected.piola).norm(), 1e-13 * expected.piola.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, EveryKind, testing::ValuesIn(every_kind()),
                         [](const auto& tested) { return name_of(tested.param); });

class EveryTurningKind : public EveryKind {};

TEST_P(EveryTurningKind, HasNoStressAfterARigidTurn) {
  for (const auto& [first, second] : {std::pair{std::numbers::pi / 2, 0.}, std::pair{1.1, 0.7}}) {
    Matrix3d turn = Eigen::AngleAxisd(first, Vector3d::UnitZ()).toRotationMatrix();
    if (GetParam().section.physics == Physics::solid)
      turn = turn * Eigen::AngleAxisd(second, Vector3d::UnitX());
    OneCell cell(GetParam(), elastic_for(GetParam()));
    ASSERT_TRUE(cell.evaluate(cell.linear_field({0.3, -1, 0.2}, turn - Matrix3d::Identity())));
    for (const auto& record : cell.records)
      EXPECT_LT(record.piola.norm(), 1e-12 * elastic.young);
    EXPECT_LT(cell.force.norm(), 1e-12 * elastic.young);
  }
}

std::vector<CellKind> every_turning_kind() {
  auto kinds = every_kind();
  std::erase_if(kinds, [](const CellKind& kind) {
    return kind.strain == StrainKind::small || kind.section.physics == Physics::axisymmetric;
  });
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Cells, EveryTurningKind, testing::ValuesIn(every_turning_kind()),
                         [](const auto& tested) { return name_of(tested.param); });

TEST(NonlinearCells, HaveTheStiffnessOfLinearElasticityInSmallStrain) {
  for (const auto& kind : every_kind()) {
    if (kind.strain != StrainKind::small || kind.formulation != Formulation::full)
      continue;
    OneCell cell(kind, elastic_for(kind));
    ASSERT_TRUE(cell.evaluate(VectorXd::Zero(cell.dofs)));
    MatrixXd k(cell.dofs, cell.dofs);
    const material::LinearElastic linear{elastic.young, elastic.poisson, 1.};
    stiffness(kind.type, cell.points, linear, kind.section, k);
    EXPECT_LT((k - cell.tangent).norm(), 1e-13 * k.norm()) << name_of(kind);
  }
}

TEST(NonlinearCells, HaveTrueStressesOfTheirMotion) {
  const ElasticLaw law{100., 0.};
  OneCell cell({CellType::hexa8, {}, StrainKind::green_lagrange, Formulation::mean_dilatation},
               PointLaws(law));
  ASSERT_TRUE(cell.evaluate(cell.linear_field({0, 0, 0}, Vector3d(0.5, 0, 0).asDiagonal())));
  for (const auto& record : cell.records) { // P = E λ(λ² − 1)/2, J = λ
    EXPECT_NEAR(record.piola(0, 0), 93.75, 1e-11);
    EXPECT_NEAR(record.cauchy[0], 93.75, 1e-11);
    EXPECT_NEAR(record.stress[0], 62.5, 1e-11);
  }
}

TEST(NonlinearCells, RememberWhatTheirPointsAndModesNeed) {
  const CellKind enhanced{CellType::hexa8, {}, StrainKind::small, Formulation::enhanced};
  EXPECT_EQ(state_size_of_cell(enhanced, 7), 8 * 7 + 12);
  OneCell cell(enhanced, PointLaws(plastic));
  std::srand(2);
  const VectorXd u = 0.02 * VectorXd::Random(cell.dofs);
  ASSERT_TRUE(cell.evaluate(u));
  const VectorXd force = cell.force;
  cell.old = cell.now;
  ASSERT_TRUE(cell.evaluate(u)); // a step without motion
  EXPECT_LT((cell.force - force).norm(), 1e-12 * force.norm());
}

/// A cell of nine nodes on the shape of one with eight.
OneCell of_nine_nodes(const OneCell& eight) {
  CellKind kind = eight.kind;
  kind.type = CellType::quad9;
  OneCell nine(kind, eight.laws);
  for (std::size_t i = 0; i < 8; ++i)
    nine.points[i] = eight.points[i];
  nine.points[8].setZero();
  for (std::size_t i = 0; i < 8; ++i)
    nine.points[8] += (i < 4 ? -0.25 : 0.5) * eight.points[i];
  return nine;
}

/// Newton's method for a middle node without force.
VectorXd with_free_middle(OneCell& nine, const VectorXd& u) {
  VectorXd all(nine.dofs);
  all << u, VectorXd::Zero(2);
  for (int i = 0; i < 8; ++i) {
    EXPECT_TRUE(nine.evaluate(all));
    const Eigen::Matrix2d k = nine.tangent.bottomRightCorner<2, 2>();
    const Eigen::Vector2d force = nine.force.tail<2>();
    all.tail<2>() -= k.inverse() * force;
  }
  EXPECT_TRUE(nine.evaluate(all));
  return all;
}

TEST(NonlinearCells, OfEightNodesWithABubbleAreThoseOfNineWithAFreeMiddle) {
  for (const auto physics : {Physics::plane_strain, Physics::axisymmetric})
    for (const auto strain : {StrainKind::small, StrainKind::green_lagrange, StrainKind::logarithmic}) {
      const CellKind kind{CellType::quad8, {physics, 1}, strain, Formulation::mean_dilatation};
      OneCell eight(kind, PointLaws(elastic));
      OneCell nine = of_nine_nodes(eight);
      const VectorXd u = some_displacement(eight);
      const auto of_eight = eight.evaluate(u);
      ASSERT_TRUE(of_eight) << name_of(kind);
      const auto of_nine = nine.evaluate(with_free_middle(nine, u));
      EXPECT_NEAR(of_eight.stored, of_nine.stored, 1e-12 * of_nine.stored) << name_of(kind);
      EXPECT_LT((eight.force - nine.force.head(16)).norm(), 1e-10 * eight.force.norm()) << name_of(kind);
      const Eigen::Matrix2d middle = nine.tangent.bottomRightCorner<2, 2>();
      const MatrixXd side = nine.tangent.topRightCorner<16, 2>();
      const MatrixXd condensed =
          nine.tangent.topLeftCorner<16, 16>() - side * middle.inverse() * side.transpose();
      EXPECT_LT((eight.tangent - condensed).norm(), 1e-10 * condensed.norm()) << name_of(kind);
    }
}

TEST(NonlinearCells, TakeALawForEachPointAndLawsOfAVariant) {
  using Any = std::variant<ElasticLaw, PlasticLaw>;
  const CellKind kind{CellType::hexa8, {}, StrainKind::small, Formulation::full};
  const std::vector<Any> many(8, Any(plastic));
  const Any one = plastic;
  OneCell plain(kind, PointLaws(plastic)), variant(kind, PointLaws(one)),
      by_point(kind, PointLaws(std::span(many)));
  const VectorXd u = 0.02 * VectorXd::Random(plain.dofs);
  for (auto* cell : {&plain, &variant, &by_point}) {
    ASSERT_TRUE(cell->evaluate(u));
    EXPECT_EQ(cell->tangent, plain.tangent);
    EXPECT_EQ(cell->now, plain.now);
  }
}

TEST(NonlinearCells, SayWhereAPointIsTurnedInsideOut) {
  for (const auto formulation :
       {Formulation::full, Formulation::mean_dilatation, Formulation::enhanced, Formulation::reduced}) {
    OneCell cell({CellType::hexa8, {}, StrainKind::green_lagrange, formulation}, PointLaws(elastic));
    const auto result = cell.evaluate(cell.linear_field({0, 0, 0}, Vector3d(-1.2, 0, 0).asDiagonal()));
    EXPECT_EQ(result.failure, Failure::inverted);
    EXPECT_EQ(result.point, 0);
  }
}

struct FailingLaw {};
int state_size(const FailingLaw&) {
  return 0;
}
bool respond(const FailingLaw&, const material::Strain6& strain, std::span<const double>, std::span<double>,
             const material::StepInfo&, material::Want, material::Response& out) {
  out = {strain, material::Tangent6::Identity(), 0};
  return strain[0] < 0.01;
}

TEST(NonlinearCells, SayWhereALawFails) {
  const FailingLaw law;
  OneCell cell({CellType::hexa8, {}, StrainKind::small, Formulation::full}, PointLaws(law));
  EXPECT_TRUE(cell.evaluate(VectorXd::Zero(cell.dofs)));
  VectorXd u = VectorXd::Zero(cell.dofs);
  u[3 * 6] = 0.1; // the corner (1, 1, 1), which the last point is next to
  const auto result = cell.evaluate(u);
  EXPECT_EQ(result.failure, Failure::law);
  EXPECT_GE(result.point, 0);
}

TEST(NonlinearCells, SayWhenTheirOwnUnknownsAreNotSolved) {
  OneCell cell({CellType::quad4, {Physics::plane_strain, 1}, StrainKind::small, Formulation::enhanced},
               PointLaws(plastic));
  cell.modes.most_iterations = 0;
  std::srand(2);
  EXPECT_EQ(cell.evaluate(VectorXd::Random(cell.dofs)).failure, Failure::mode_iteration);
}

TEST(NonlinearCells, RefuseKindsThatAreNotOffered) {
  OneCell cell({CellType::hexa20, {}, StrainKind::small, Formulation::full}, PointLaws(elastic));
  cell.kind.formulation = Formulation::enhanced;
  EXPECT_THROW(cell.evaluate(VectorXd::Zero(cell.dofs)), std::invalid_argument);
  EXPECT_FALSE(is_offered(
      {CellType::quad4, {Physics::plane_stress, 1}, StrainKind::small, Formulation::mean_dilatation}));
  for (const auto type : {CellType::tetra4, CellType::pyra5, CellType::pyra13})
    EXPECT_FALSE(is_offered({type, {}, StrainKind::small, Formulation::mean_dilatation}));
  EXPECT_FALSE(is_offered({CellType::hexa8, {}, StrainKind::logarithmic, Formulation::enhanced}));
  EXPECT_FALSE(is_offered({CellType::quad4, {}, StrainKind::small, Formulation::full}));
  EXPECT_FALSE(is_offered({CellType::hexa20, {}, StrainKind::small, Formulation::reduced}));
}

} // namespace
} // namespace rubato::element::nonlinear_test
