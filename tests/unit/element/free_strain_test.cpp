// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells whose points expand freely, by temperature.
#include "rubato/element/nonlinear.hpp"
#include "rubato/material/point_law.hpp"

#include <gtest/gtest.h>

#include "kind_cases.hpp"
#include "point_test_laws.hpp"
#include <cmath>

namespace rubato::element::free_strain_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using material::PointLaw;
using material::Strain6;
using study::Physics;

const test::ElasticLaw elastic{210., 0.3};
const test::PlasticLaw plastic{elastic, 0.05, 5.};
const test::NeoHookeanLaw rubber{80., 250.};
const test::PlaneStressLaw<test::ElasticLaw> flat_elastic{elastic};
const test::PlaneStressLaw<test::PlasticLaw> flat_plastic{plastic};

bool is_flat(const CellKind& kind) {
  return kind.section.physics == Physics::plane_stress;
}

PointLaws elastic_for(const CellKind& kind) {
  return is_flat(kind) ? PointLaws(flat_elastic) : PointLaws(elastic);
}

PointLaws curved_for(const CellKind& kind) {
  if (is_flat(kind))
    return PointLaws(flat_plastic);
  return kind.strain == StrainKind::green_lagrange ? PointLaws(rubber) : PointLaws(plastic);
}

Strain6 isotropic(double a) {
  Strain6 strain;
  strain << a, a, a, 0, 0, 0;
  return strain;
}

std::vector<Strain6> everywhere(const CellKind& kind, const Strain6& strain) {
  return std::vector(static_cast<std::size_t>(point_count(kind)), strain);
}

/// Different at each point.
std::vector<Strain6> varying(const CellKind& kind) {
  auto strains = everywhere(kind, isotropic(0));
  for (std::size_t q = 0; q < strains.size(); ++q)
    strains[q] = isotropic(0.01 + 0.004 * std::sin(3. * static_cast<double>(q)));
  return strains;
}

/// The stretch that a free strain makes.
double free_stretch(StrainKind kind, double strain, bool is_hyperelastic) {
  if (kind == StrainKind::small || is_hyperelastic)
    return 1 + strain;
  return kind == StrainKind::green_lagrange ? std::sqrt(1 + 2 * strain) : std::exp(strain);
}

class EveryWarmKind : public testing::TestWithParam<CellKind> {};

TEST_P(EveryWarmKind, HasTheDerivativeOfItsForcesAsTangent) {
  for (const auto& laws : {elastic_for(GetParam()), curved_for(GetParam())}) {
    OneCell cell(GetParam(), laws);
    cell.free_strain = varying(GetParam());
    EXPECT_LT(error_of_tangent(cell), 1e-8);
  }
}

TEST_P(EveryWarmKind, HasTheDerivativeOfItsEnergyAsForces) {
  constexpr double h = 1e-4;
  const bool may_be_rubber = GetParam().strain == StrainKind::green_lagrange && !is_flat(GetParam());
  OneCell cell(GetParam(), may_be_rubber ? curved_for(GetParam()) : elastic_for(GetParam()));
  cell.free_strain = varying(GetParam());
  const VectorXd u = some_displacement(cell);
  ASSERT_TRUE(cell.evaluate(u));
  const VectorXd force = cell.force;
  for (Eigen::Index j = 0; j < cell.dofs; ++j) {
    const auto energy_at = [&](double step) {
      VectorXd moved = u;
      moved[j] += step;
      const auto found = cell.evaluate(moved);
      return found.stored + found.hourglass;
    };
    const double near = energy_at(h) - energy_at(-h), far = energy_at(2 * h) - energy_at(-2 * h);
    EXPECT_NEAR((8 * near - far) / (12 * h), force[j], 1e-8 * force.cwiseAbs().maxCoeff());
  }
}

TEST_P(EveryWarmKind, HasNoStressWhereItExpandsFreely) {
  constexpr double strain = 0.02;
  const bool held_along_z = GetParam().section.physics == Physics::plane_strain;
  auto free = isotropic(strain);
  if (held_along_z)
    free[2] = 0;
  for (const auto& laws : {elastic_for(GetParam()), curved_for(GetParam())}) {
    if (held_along_z && laws.is_hyperelastic())
      continue;
    OneCell cell(GetParam(), laws);
    cell.free_strain = everywhere(GetParam(), free);
    const double stretch = free_stretch(GetParam().strain, strain, laws.is_hyperelastic());
    const Matrix3d h = (stretch - 1) * Matrix3d::Identity();
    ASSERT_TRUE(cell.evaluate(cell.linear_field({0, 0.1, 0}, h)));
    for (const auto& record : cell.records) {
      EXPECT_LT(record.piola.norm(), 1e-13 * elastic.young);
      EXPECT_LT(record.cauchy.norm(), 1e-13 * elastic.young);
      EXPECT_NEAR(record.gradient(0, 0), stretch - 1, 1e-15) << "the gradient is that of the motion";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, EveryWarmKind, testing::ValuesIn(every_kind()),
                         [](const auto& tested) { return name_of(tested.param); });

TEST(FreeStrain, PressesAHeldCube) {
  const test::ElasticLaw steel{2e5, 0.3};
  for (const auto formulation : {Formulation::full, Formulation::mean_dilatation, Formulation::enhanced}) {
    OneCell cell({CellType::hexa8, {}, StrainKind::small, formulation}, PointLaws(steel));
    cell.free_strain = everywhere(cell.kind, isotropic(1.2e-3));
    ASSERT_TRUE(cell.evaluate(VectorXd::Zero(cell.dofs)));
    for (const auto& record : cell.records) // −E α ΔT/(1 − 2ν)
      for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(record.stress[i], i < 3 ? -600 : 0, 1e-12);
        EXPECT_NEAR(record.cauchy[i], i < 3 ? -600 : 0, 1e-12);
      }
  }
}

/// Every hyperelastic law of material, in space and in plane stress.
TEST(FreeStrain, DividesTheMotionThatHyperelasticLawsSee) {
  constexpr double a = 0.05;
  const material::SpaceLaw mooney = material::MooneyRivlin{0.4, 0.1, 50.};
  const material::SpaceLaw yeoh = material::Yeoh{0.5, -0.02, 0.01, 50.};
  const material::SpaceLaw ogden = material::Ogden{{{0.6, 1.3}, {0.4, -2.}}, 50.};
  for (const auto& law : {mooney, yeoh, ogden}) {
    const PointLaw in_space = std::visit([](const auto& one) { return PointLaw(one); }, law);
    EXPECT_TRUE(is_hyperelastic(in_space));
    const CellKind kind{CellType::hexa8, {}, StrainKind::green_lagrange, Formulation::mean_dilatation};
    OneCell cold(kind, PointLaws(in_space)), warm(kind, PointLaws(in_space));
    warm.free_strain = everywhere(kind, isotropic(a));
    const VectorXd u = some_displacement(cold);
    const VectorXd expanded = (1 + a) * u + a * cold.linear_field({0, 0, 0}, Matrix3d::Identity());
    const auto before = cold.evaluate(u), after = warm.evaluate(expanded);
    EXPECT_NEAR(after.stored, before.stored, 1e-12 * before.stored);
    EXPECT_LT((cold.force / (1 + a) - warm.force).norm(), 1e-12 * cold.force.norm());

    const PointLaw flat_law = material::PlaneStress{law};
    EXPECT_TRUE(is_hyperelastic(flat_law));
    OneCell flat(
        {CellType::quad8, {Physics::plane_stress, 0.3}, StrainKind::green_lagrange, Formulation::full},
        PointLaws(flat_law));
    flat.free_strain = varying(flat.kind);
    EXPECT_LT(error_of_tangent(flat), 1e-8);
  }
}

TEST(FreeStrain, MayDifferAlongTheAxesOfOrthotropicLaws) {
  Strain6 strain;
  strain << 0.01, -0.02, 0.03, 0, 0, 0;
  for (const auto kind : {StrainKind::small, StrainKind::green_lagrange, StrainKind::logarithmic}) {
    OneCell cell({CellType::hexa20, {}, kind, Formulation::full}, PointLaws(plastic));
    cell.free_strain = everywhere(cell.kind, strain);
    Vector3d change;
    for (int i = 0; i < 3; ++i)
      change[i] = free_stretch(kind, strain[i], false) - 1;
    ASSERT_TRUE(cell.evaluate(cell.linear_field({0, 0, 0}, change.asDiagonal())));
    for (const auto& record : cell.records) {
      EXPECT_LT(record.strain.norm(), 1e-15);
      EXPECT_LT(record.piola.norm(), 1e-13 * elastic.young);
    }
  }
}

TEST(FreeStrain, IsTakenFromTheStrainsOfOtherLaws) {
  for (const PointLaw& law : {PointLaw(material::make_elastic_point(1., 0.3)), PointLaw(material::Prony{}),
                              PointLaw(material::Plastic{})})
    EXPECT_FALSE(is_hyperelastic(law));
}

} // namespace
} // namespace rubato::element::free_strain_test
