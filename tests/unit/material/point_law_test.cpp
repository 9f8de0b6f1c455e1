// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/point_law.hpp"
#include "rubato/material/voigt.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/point_path.hpp"
#include <string>

namespace rubato::material::point_law_test {
namespace {

using test::PointPath;
using test::random_six;

struct Row {
  std::string name;
  PointLaw law;
  double size; ///< of strains
  bool plane = false;
  bool isotropic = true;
  bool balances = true; ///< stress linear in the elastic strain
};

Orthotropic wood() {
  study::Orthotropy o;
  o.young_x = 11600, o.young_y = 900, o.young_z = 500;
  o.poisson_xy = 0.37, o.poisson_yz = 0.43, o.poisson_xz = 0.47;
  o.shear_xy = 750, o.shear_yz = 39, o.shear_xz = 720;
  o.angle_z = 30;
  return make_orthotropic(o, 0);
}

Plastic steel(Hardening hardening, BackStresses back = {}) {
  return {200e3, 0.3, std::move(hardening), back};
}

const BackStresses prager{{BackStress{20e3, 0}}, 1};
const BackStresses armstrong{{BackStress{20e3, 100}}, 1};
const BackStresses three{{BackStress{20e3, 100}, BackStress{5e3, 0}, BackStress{50e3, 400}}, 3};
const TableHardening table{{{0, 200}, {0.01, 260}, {0.03, 300}}};
const VoceHardening voce{200, 100, 50, 500};
const JohnsonCook fast{200, 300, 0.3, 0.02, 1e-5, 0.9};
const Prony polymer{2.6, 0.3, {{2, 0.1}, {3, 1}}};
const MooneyRivlin rubber{0.4, 0.1, 20};
const Ogden three_terms{{{0.6, 1.3}, {0.01, 5}, {0.1, -2}}, 20};

std::vector<Row> rows() {
  return {
      {"elastic", make_elastic_point(200e3, 0.3), 1e-2},
      {"wood", make_elastic_point(wood()), 1e-2, false, false},
      {"linear", steel(LinearHardening{200, 2000}), 1e-2},
      {"perfect", steel(LinearHardening{200, 0}), 1e-2},
      {"table", steel(table), 1e-2},
      {"voce", steel(voce), 1e-2},
      {"johnson_cook", steel(fast), 1e-2},
      {"prager", steel(LinearHardening{200, 2000}, prager), 1e-2},
      {"prager_voce", steel(voce, prager), 1e-2},
      {"armstrong_linear", steel(LinearHardening{200, 2000}, armstrong), 1e-2},
      {"armstrong_voce", steel(voce, armstrong), 1e-2},
      {"armstrong_johnson_cook", steel(fast, armstrong), 1e-2},
      {"three", steel(voce, three), 1e-2},
      {"prony", polymer, 1e-2},
      {"neo_hookean", MooneyRivlin{0.5, 0, 20}, 0.2, false, true, false},
      {"mooney_rivlin", rubber, 0.2, false, true, false},
      {"mooney_rivlin_quadratic", MooneyRivlin{0.4, 0.1, 20, Volumetric::quadratic}, 0.2, false, true, false},
      {"yeoh", Yeoh{0.5, -0.05, 0.02, 20}, 0.2, false, true, false},
      {"ogden", three_terms, 0.2, false, true, false},
      {"plane_elastic", PlaneStress{make_elastic_point(200e3, 0.3)}, 1e-2, true},
      {"plane_wood", PlaneStress{make_elastic_point(wood())}, 1e-2, true, false},
      {"plane_linear", PlaneStress{steel(LinearHardening{200, 2000})}, 1e-2, true},
      {"plane_three", PlaneStress{steel(voce, three)}, 1e-2, true},
      {"plane_johnson_cook", PlaneStress{steel(fast)}, 1e-2, true},
      {"plane_prony", PlaneStress{polymer}, 1e-2, true},
      {"plane_rubber", PlaneStress{rubber}, 0.2, true, true, false},
      {"plane_ogden", PlaneStress{three_terms}, 0.2, true, true, false},
  };
}

/// Strains of a plane have no yz and xz.
Strain6 strain_of(const Row& row, std::mt19937& engine) {
  auto strain = random_six(engine, row.size);
  if (row.plane)
    strain[2] = strain[4] = strain[5] = 0;
  return strain;
}

class PointLaws : public testing::TestWithParam<Row> {};

TEST_P(PointLaws, HaveTheTangentThatDifferencesHave) {
  std::mt19937 engine(5);
  const auto& row = GetParam();
  for (int trial = 0; trial < 8; ++trial) {
    PointPath path(row.law);
    for (int step = 0; step < 3; ++step)
      ASSERT_TRUE(path.to_strain(strain_of(row, engine)));
    const auto strain = strain_of(row, engine);
    const auto expected = test::tangent_by_differences(path, strain, 0.7, 2e-4 * row.size);
    ASSERT_TRUE(path.to_strain(strain, 0.7));
    const auto& tangent = path.response().tangent;
    EXPECT_LT((tangent - expected).cwiseAbs().maxCoeff(), 1e-8 * tangent.cwiseAbs().maxCoeff());
    const double skew = (tangent - tangent.transpose()).cwiseAbs().maxCoeff();
    EXPECT_TRUE(skew < 4e-15 * tangent.cwiseAbs().maxCoeff() || !tangent_is_symmetric(row.law)) << skew;
  }
}

TEST_P(PointLaws, GiveTheSameStressWithAndWithoutTheTangent) {
  std::mt19937 engine(6);
  const auto& row = GetParam();
  PointPath path(row.law);
  ASSERT_TRUE(path.to_strain(strain_of(row, engine)));
  const auto strain = strain_of(row, engine);
  std::vector<double> now(path.state());
  Response alone;
  ASSERT_TRUE(respond(row.law, strain, path.state(), now, {1}, Want::stress, alone));
  ASSERT_TRUE(path.to_strain(strain));
  EXPECT_EQ(alone.stress, path.response().stress);
  EXPECT_EQ(alone.stored, path.response().stored);
  EXPECT_EQ(now, path.state());
}

TEST_P(PointLaws, BalanceTheirWork) {
  std::mt19937 engine(7);
  const auto& row = GetParam();
  if (!row.balances)
    return;
  PointPath path(row.law);
  for (int step = 0; step < 500; ++step)
    ASSERT_TRUE(path.to_strain(strain_of(row, engine), 0.3));
  const auto& lost = path.lost;
  const double sum = path.response().stored + lost.plastic + lost.back_stress + lost.viscous;
  EXPECT_NEAR(path.work, sum, (row.plane ? 1e-11 : 1e-14) * path.gross);
}

TEST_P(PointLaws, GiveTurnedStressesToTurnedStrains) {
  std::mt19937 engine(8);
  const auto& row = GetParam();
  if (!row.isotropic)
    return;
  const Eigen::Matrix3d axes = (Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()) *
                                Eigen::AngleAxisd(row.plane ? 0 : 1.1, Eigen::Vector3d(1, 2, 3).normalized()))
                                   .toRotationMatrix();
  PointPath path(row.law);
  PointPath turned(row.law);
  for (int step = 0; step < 20; ++step) {
    const auto strain = strain_of(row, engine);
    ASSERT_TRUE(path.to_strain(strain));
    ASSERT_TRUE(turned.to_strain(strain_rotation(axes) * strain));
    const Stress6 expected = strain_rotation(axes.transpose()).transpose() * path.response().stress;
    EXPECT_LT((turned.response().stress - expected).norm(), 1e-11 * expected.norm()) << step;
  }
}

TEST_P(PointLaws, StoreNothingAtRest) {
  const PointPath path(GetParam().law);
  ASSERT_TRUE(path.works());
  EXPECT_EQ(path.response().stored, 0);
  EXPECT_EQ(path.response().stress.norm(), 0);
}

INSTANTIATE_TEST_SUITE_P(Each, PointLaws, testing::ValuesIn(rows()),
                         [](const auto& given) { return given.param.name; });

TEST(PointLaw, KnowsWhichLawsDependOnTheRateAndHaveSymmetricTangents) {
  EXPECT_TRUE(depends_on_rate(steel(fast)));
  EXPECT_TRUE(depends_on_rate(PlaneStress{polymer}));
  EXPECT_FALSE(depends_on_rate(steel(voce, three)));
  EXPECT_FALSE(tangent_is_symmetric(PlaneStress{steel(voce, armstrong)}));
  EXPECT_TRUE(tangent_is_symmetric(steel(voce, prager)));
}

} // namespace
} // namespace rubato::material::point_law_test
