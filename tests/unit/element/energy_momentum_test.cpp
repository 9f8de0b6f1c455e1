// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/energy_momentum.hpp"
#include "rubato/material/point_law.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "kind_cases.hpp"
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace rubato::element::energy_momentum_test {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using material::PointLaw;
using material::SpaceLaw;
using material::Strain6;
using study::Physics;

struct BetweenCase {
  CellKind kind;
  std::string law_name;
  PointLaw law;
};

std::string name_of(const BetweenCase& tested) {
  return element::name_of(tested.kind) + tested.law_name;
}

void PrintTo(const BetweenCase& tested, std::ostream* out) {
  *out << name_of(tested);
}

struct NamedLaw {
  std::string name;
  SpaceLaw law;
};

Strain6 isotropic(double a) {
  Strain6 strain;
  strain << a, a, a, 0, 0, 0;
  return strain;
}

/// Of three moduli, not isotropic.
SpaceLaw orthotropic() {
  material::ElasticPoint law = material::make_elastic_point(210., 0.3);
  const Strain6 along = Strain6::Unit(0) - 0.5 * Strain6::Unit(1) + 0.3 * Strain6::Unit(4);
  law.stiffness += 150. * along * along.transpose();
  return law;
}

std::vector<NamedLaw> laws_for(const CellKind& kind) {
  const NamedLaw elastic{"Elastic", material::make_elastic_point(210., 0.3)};
  if (kind.strain != StrainKind::green_lagrange)
    return {elastic, {"Orthotropic", orthotropic()}};
  return {elastic,
          {"Orthotropic", orthotropic()},
          {"Mooney", material::MooneyRivlin{30., 10., 400.}},
          {"Yeoh", material::Yeoh{40., -2., 3., 400.}},
          {"Ogden", material::Ogden{{{50., 1.3}, {30., -2.}}, 400.}}};
}

/// Every cell with every law that it may have.
std::vector<BetweenCase> every_case() {
  std::vector<BetweenCase> cases;
  for (const auto& kind : every_kind())
    if (is_offered_between(kind))
      for (const auto& [name, law] : laws_for(kind)) {
        const bool flat = kind.section.physics == Physics::plane_stress;
        cases.push_back({kind, name,
                         flat ? PointLaw(material::PlaneStress{law})
                              : std::visit([](const auto& one) { return PointLaw(one); }, law)});
      }
  return cases;
}

/// A cell over a step, its modes at the start those of its displacement then.
struct OneStep {
  explicit OneStep(const BetweenCase& of)
      : law(std::make_unique<PointLaw>(of.law)), cell(of.kind, PointLaws(*law)), force(cell.dofs),
        tangent(cell.dofs, cell.dofs), exact(tangent), now(cell.old), records(cell.records) {}

  BetweenResult evaluate(const VectorXd& before, const VectorXd& after) {
    const auto size = static_cast<std::size_t>(cell.dofs);
    return evaluate_between(
        cell.kind, cell.laws,
        {cell.points,
         {before.data(), size},
         {after.data(), size},
         cell.old,
         cell.step,
         cell.modes,
         cell.free_strain},
        {now, {force.data(), size}, {tangent.data(), size * size}, {exact.data(), size * size}, records});
  }

  /// Remembers the modes that belong to a displacement.
  void start_at(const VectorXd& before) {
    ASSERT_TRUE(cell.evaluate(before));
    cell.old = cell.now;
  }

  void heat() {
    for (int q = 0; q < point_count(cell.kind); ++q)
      cell.free_strain.push_back(isotropic(0.01 + 0.004 * std::sin(3. * q)));
  }

  std::unique_ptr<PointLaw> law;
  OneCell cell;
  VectorXd force;
  MatrixXd tangent, exact;
  std::vector<double> now;
  std::vector<PointRecord> records;
};

struct Motion {
  VectorXd before, after;
};

/// Random strains, and where the cell may turn, large motions with them.
Motion some_motion(const OneCell& cell, int seed) {
  constexpr double size = 0.04; // cells are about 1 long
  std::srand(static_cast<unsigned>(seed));
  Motion motion;
  motion.before = size * VectorXd::Random(cell.dofs);
  motion.after = size * VectorXd::Random(cell.dofs);
  if (cell.kind.strain == StrainKind::small || cell.kind.section.physics == Physics::axisymmetric)
    return motion;
  const bool solid = cell.kind.section.physics == Physics::solid;
  for (auto* u : {&motion.before, &motion.after}) {
    const Vector3d axis = solid ? Vector3d(Vector3d::Random().normalized()) : Vector3d::UnitZ();
    const Matrix3d turn = Eigen::AngleAxisd(u == &motion.before ? 0.4 : 1.1, axis).toRotationMatrix();
    for (Eigen::Index i = 0; i < cell.dofs; i += cell.d)
      u->segment(i, cell.d) = (turn.topLeftCorner(cell.d, cell.d) * u->segment(i, cell.d)).eval();
    *u += cell.linear_field(Vector3d::Random(), turn - Matrix3d::Identity());
  }
  return motion;
}

class EveryStep : public testing::TestWithParam<BetweenCase> {};

TEST_P(EveryStep, DoesTheWorkThatIsStored) {
  OneStep step(GetParam());
  for (int seed = 1; seed <= 6; ++seed) {
    const auto [before, after] = some_motion(step.cell, seed);
    step.start_at(before);
    const auto result = step.evaluate(before, after);
    ASSERT_TRUE(result);
    const double change = result.after.stored - result.stored_before;
    EXPECT_NEAR(step.force.dot(after - before), change, 1e-12 * (result.after.stored + result.stored_before));
    if (seed == 3)
      step.heat();
  }
}

/// Of forces on nodes.
Vector3d resultant(const OneStep& step) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < step.cell.points.size(); ++i)
    sum.head(step.cell.d) += step.force.segment(static_cast<Eigen::Index>(i) * step.cell.d, step.cell.d);
  return sum;
}

Vector3d moment(const OneStep& step, const Motion& motion) {
  const int d = step.cell.d;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < step.cell.points.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i) * d;
    Vector3d x = step.cell.points[i], f = Vector3d::Zero();
    x.head(d) += 0.5 * (motion.before.segment(at, d) + motion.after.segment(at, d));
    f.head(d) = step.force.segment(at, d);
    sum += x.cross(f);
  }
  return sum;
}

TEST_P(EveryStep, HasNoResultantAndNoMoment) {
  OneStep step(GetParam());
  const auto& kind = GetParam().kind;
  for (int seed = 1; seed <= 6; ++seed) {
    const auto motion = some_motion(step.cell, seed);
    step.start_at(motion.before);
    ASSERT_TRUE(step.evaluate(motion.before, motion.after));
    const double size = step.force.cwiseAbs().sum();
    if (kind.section.physics == Physics::axisymmetric) {
      EXPECT_NEAR(resultant(step)[1], 0, 1e-12 * size) << "along the axis";
      continue;
    }
    EXPECT_LT(resultant(step).norm(), 1e-12 * size);
    if (kind.strain == StrainKind::small) // which knows turns that are small only
      continue;
    EXPECT_LT(moment(step, motion).norm(), 3 * 1e-12 * size) << "places are up to 3 away";
  }
}

/// Differences of fourth order by the displacement j of the end.
VectorXd force_difference(OneStep& step, const Motion& motion, Eigen::Index j) {
  constexpr double h = 2e-4;
  const auto force_at = [&](double by) {
    VectorXd moved = motion.after;
    moved[j] += by;
    EXPECT_TRUE(step.evaluate(motion.before, moved));
    return VectorXd(step.force);
  };
  const VectorXd near = force_at(h) - force_at(-h), far = force_at(2 * h) - force_at(-2 * h);
  return (8 * near - far) / (12 * h);
}

TEST_P(EveryStep, HasTheDerivativeOfItsForces) {
  for (const bool warm : {false, true}) {
    OneStep step(GetParam());
    if (warm)
      step.heat();
    const auto motion = some_motion(step.cell, 7);
    step.start_at(motion.before);
    ASSERT_TRUE(step.evaluate(motion.before, motion.after));
    const MatrixXd k = step.exact;
    double error = 0;
    for (Eigen::Index j = 0; j < step.cell.dofs; ++j)
      error = std::max(error, (force_difference(step, motion, j) - k.col(j)).cwiseAbs().maxCoeff());
    EXPECT_LT(error, 1e-7 * k.cwiseAbs().maxCoeff());
  }
}

/// The symmetric tangent is nearer to the derivative, the shorter the step.
TEST_P(EveryStep, HasASymmetricTangentOfFirstOrder) {
  OneStep step(GetParam());
  const auto motion = some_motion(step.cell, 8);
  step.start_at(motion.before);
  for (const double part : {1e-2, 1e-4}) {
    const VectorXd after = motion.before + part * (motion.after - motion.before);
    ASSERT_TRUE(step.evaluate(motion.before, after));
    EXPECT_EQ(step.tangent, MatrixXd(step.tangent.transpose()));
    EXPECT_LT((step.tangent - step.exact).norm(), 2 * part * step.exact.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, EveryStep, testing::ValuesIn(every_case()),
                         [](const auto& tested) { return name_of(tested.param); });

BetweenCase rubber_case(CellType type, Physics physics, Formulation formulation) {
  return {{type, {physics, 1}, StrainKind::green_lagrange, formulation},
          "Mooney",
          material::MooneyRivlin{30., 10., 400.}};
}

TEST(EnergyMomentum, HasTheForcesOfTheEndsWhereNothingMoves) {
  for (const auto formulation : {Formulation::full, Formulation::mean_dilatation}) {
    OneStep step(rubber_case(CellType::hexa8, Physics::solid, formulation));
    const auto [before, after] = some_motion(step.cell, 2);
    ASSERT_TRUE(step.cell.evaluate(before));
    ASSERT_TRUE(step.evaluate(before, before));
    EXPECT_LT((step.force - step.cell.force).norm(), 1e-13 * step.cell.force.norm());
    EXPECT_LT((step.tangent - step.cell.tangent / 2).norm(), 1e-12 * step.tangent.norm());
  }
}

/// Where a strained cell flies, [U] and [C] are what rounding leaves: their ratio must not become a stress.
TEST(EnergyMomentum, DoesNotMakeStressesOfRounding) {
  for (const auto& tested : every_case()) {
    if (tested.kind.strain == StrainKind::small || tested.kind.section.physics == Physics::axisymmetric)
      continue;
    OneStep step(tested);
    const auto [before, after] = some_motion(step.cell, 2);
    step.start_at(before);
    ASSERT_TRUE(step.cell.evaluate(before));
    for (const double way : {1e-3, 1., 1e3}) {
      const VectorXd moved = before + step.cell.linear_field(Vector3d(way, -way, way), Matrix3d::Zero());
      ASSERT_TRUE(step.evaluate(before, moved));
      EXPECT_LT((step.force - step.cell.force).norm(), 1e-15 * (1e3 + 1e4 * way) * step.cell.force.norm())
          << name_of(tested) << ' ' << way;
    }
  }
}

TEST(EnergyMomentum, IsTheMeanOfTheForcesInSmallStrain) {
  for (const auto& kind : every_kind()) {
    if (!is_offered_between(kind) || kind.strain != StrainKind::small ||
        kind.section.physics == Physics::plane_stress)
      continue;
    OneStep step({kind, "Elastic", material::make_elastic_point(210., 0.3)});
    step.heat();
    const auto [before, after] = some_motion(step.cell, 3);
    ASSERT_TRUE(step.cell.evaluate(before));
    VectorXd mean = step.cell.force / 2;
    ASSERT_TRUE(step.cell.evaluate(after));
    mean += step.cell.force / 2;
    ASSERT_TRUE(step.evaluate(before, after));
    EXPECT_LT((step.force - mean).norm(), 1e-11 * mean.norm()) << element::name_of(kind);
    EXPECT_LT((step.tangent - step.cell.tangent / 2).norm(), 1e-11 * step.tangent.norm());
    EXPECT_EQ(step.tangent, step.exact);
  }
}

TEST(EnergyMomentum, TellsOfTheEndWhatAnEvaluationThereTells) {
  for (const auto& tested : every_case()) {
    if (mode_count(tested.kind) > 0)
      continue; // its modes are those of the step
    OneStep step(tested);
    step.heat();
    const auto [before, after] = some_motion(step.cell, 4);
    const auto start = step.cell.evaluate(before), end = step.cell.evaluate(after);
    const auto result = step.evaluate(before, after);
    ASSERT_TRUE(start && end && result);
    EXPECT_NEAR(result.stored_before, start.stored, 1e-13 * start.stored);
    EXPECT_NEAR(result.after.stored, end.stored, 1e-13 * end.stored);
    for (std::size_t q = 0; q < step.records.size(); ++q) {
      const auto &here = step.records[q], &there = step.cell.records[q];
      EXPECT_NEAR(here.volume, there.volume, 1e-14 * there.volume);
      EXPECT_NEAR(here.stored, there.stored, 1e-12 * end.stored / there.volume);
      EXPECT_LT((here.strain - there.strain).norm(), 1e-13);
      EXPECT_LT((here.stress - there.stress).norm(), 1e-11 * there.stress.norm()) << name_of(tested);
      EXPECT_LT((here.cauchy - there.cauchy).norm(), 1e-11 * there.cauchy.norm()) << name_of(tested);
      EXPECT_LT((here.gradient - there.gradient).norm(), 1e-13);
      EXPECT_LT((here.piola - there.piola).norm(), 1e-11 * there.piola.norm()) << name_of(tested);
    }
  }
}

TEST(EnergyMomentum, SaysWhereAPointIsTurnedInsideOutAtEitherEnd) {
  OneStep step(rubber_case(CellType::hexa8, Physics::solid, Formulation::mean_dilatation));
  const VectorXd rest = VectorXd::Zero(step.cell.dofs);
  const VectorXd turned = step.cell.linear_field({0, 0, 0}, Vector3d(-1.2, 0, 0).asDiagonal());
  EXPECT_EQ(step.evaluate(rest, turned).after.failure, Failure::inverted);
  EXPECT_EQ(step.evaluate(turned, rest).after.failure, Failure::inverted);
  EXPECT_EQ(step.evaluate(turned, rest).after.point, 0);
}

TEST(EnergyMomentum, SaysWhenTheCellsOwnUnknownsAreNotSolved) {
  OneStep step(rubber_case(CellType::quad4, Physics::plane_strain, Formulation::enhanced));
  step.cell.modes.most_iterations = 0;
  const auto [before, after] = some_motion(step.cell, 5);
  EXPECT_EQ(step.evaluate(before, after).after.failure, Failure::mode_iteration);
}

TEST(EnergyMomentum, RefusesKindsThatAreNotOffered) {
  const CellKind kind{CellType::hexa8, {}, StrainKind::logarithmic, Formulation::enhanced};
  EXPECT_FALSE(is_offered_between(kind));
  OneStep step(rubber_case(CellType::hexa8, Physics::solid, Formulation::full));
  step.cell.kind = kind;
  const VectorXd rest = VectorXd::Zero(step.cell.dofs);
  EXPECT_THROW(step.evaluate(rest, rest), std::invalid_argument);
}

} // namespace
} // namespace rubato::element::energy_momentum_test
