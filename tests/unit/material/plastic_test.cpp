// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/plastic.hpp"
#include "rubato/material/voigt.hpp"

#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::plastic_test {
namespace {

using test::PointPath;
using test::random_six;

constexpr double young = 200e3;

Plastic steel(Hardening hardening, BackStresses back = {}) {
  return {young, 0.3, std::move(hardening), back};
}

BackStresses one_back_stress(double modulus, double recall) {
  return {{BackStress{modulus, recall}}, 1};
}

/// σ_xx of a bar pulled to `strain` in equal steps.
double tension(PointPath& path, double strain, int steps) {
  const double start = path.strain()[0];
  for (int i = 1; i <= steps; ++i)
    EXPECT_TRUE(path.pull(start + (strain - start) * i / steps));
  return path.response().stress[0];
}

TEST(Plastic, PragersBarFollowsTheBilinearLoop) {
  const double tangent = young * 20e3 / (young + 20e3);
  const double expected = 200 + tangent * (0.01 - 200 / young);
  PointPath path(steel(LinearHardening{200, 0}, one_back_stress(20e3, 0)));
  EXPECT_NEAR(tension(path, 0.01, 1), expected, 1e-11 * expected);
  EXPECT_NEAR(expected, 363.6364, 1e-4);
  EXPECT_NEAR(tension(path, -0.01, 3), -expected, 1e-11 * expected);
  EXPECT_NEAR(tension(path, 0.01, 2), expected, 1e-11 * expected);
}

TEST(Plastic, LinearHardeningHasTheTangentModulusOfItsBar) {
  const double tangent = 2000;
  PointPath path(steel(LinearHardening{200, hardening_modulus(young, tangent)}));
  const double expected = 200 + tangent * (0.02 - 200 / young);
  EXPECT_NEAR(tension(path, 0.02, 1), expected, 1e-11 * expected);
}

TEST(Plastic, VoceAndTablesFollowTheirCurveInTension) {
  PointPath voce(steel(VoceHardening{200, 100, 50, 500}));
  EXPECT_NEAR(tension(voce, 0.05, 1), 315.329889, 5e-7);
  PointPath many(steel(VoceHardening{200, 100, 50, 500}));
  EXPECT_NEAR(tension(many, 0.05, 37), 315.329889, 5e-7); // straight paths do not depend on the steps
  PointPath table(steel(TableHardening{{{0, 200}, {0.01, 260}, {0.03, 300}}}));
  EXPECT_NEAR(tension(table, 0.025, 1), 287.128713, 5e-7);
}

TEST(Plastic, ArmstrongAndFrederickConvergeWithFirstOrder) {
  const auto law = steel(LinearHardening{200, 0}, one_back_stress(20e3, 100));
  const std::array<std::pair<int, double>, 3> measured{{{10, 362.26}, {100, 366.92}, {1000, 367.418}}};
  for (const auto& [steps, expected] : measured) {
    PointPath path(law);
    EXPECT_NEAR(tension(path, 0.02, steps), expected, 0.006) << steps;
  }
  PointPath fine(law);
  EXPECT_NEAR(tension(fine, 0.02, 10'000), 367.4735, 0.007); // σ_y + C/γ (1 − e^(−γ ε^p))
}

TEST(Plastic, BackStressesAddUp) {
  PointPath one(steel(VoceHardening{200, 100, 50, 500}, one_back_stress(30e3, 80)));
  PointPath three(steel(VoceHardening{200, 100, 50, 500},
                        {{BackStress{10e3, 80}, BackStress{15e3, 80}, BackStress{5e3, 80}}, 3}));
  std::mt19937 engine(3);
  for (int i = 0; i < 20; ++i) {
    const auto strain = random_six(engine, 0.01);
    ASSERT_TRUE(one.to_strain(strain) && three.to_strain(strain));
    EXPECT_LT((one.response().stress - three.response().stress).norm(), 1e-10 * one.response().stress.norm());
  }
}

/// Code_Aster's ssnp15a: tension and shear, the stresses are given.
TEST(Plastic, TensionAndShearFollowSsnp15) {
  const std::array<bool, 6> stresses{};
  const auto stress = [](double tension, double shear) {
    Stress6 s = Stress6::Zero();
    s[0] = tension, s[3] = shear;
    return s;
  };
  PointPath path(Plastic{195e3, 0.3, LinearHardening{181, hardening_modulus(195e3, 1930)}, {}});
  ASSERT_TRUE(path.to_mixed(stresses, stress(151.2, 93.1)));
  EXPECT_NEAR(path.strain()[0], 0.0148297, 5e-8);
  EXPECT_NEAR(path.strain()[3] / 2, 0.0136014, 5e-8);
  EXPECT_NEAR(path.p(), 0.0205473, 5e-8);
  constexpr int steps = 400;
  for (int i = 1; i <= steps; ++i)
    ASSERT_TRUE(path.to_mixed(stresses, stress(151.2 + 106.0 * i / steps, 93.1 - 60.0 * i / steps)));
  EXPECT_NEAR(path.strain()[0], 0.035265, 1e-5);
  EXPECT_NEAR(path.strain()[3] / 2, 0.020471, 1.5e-5);
  EXPECT_NEAR(path.p(), 0.0423293, 2e-5);
}

TEST(Plastic, PerfectPlasticityStaysOnTheYieldSurface) {
  PointPath path(steel(LinearHardening{200, 0}));
  std::mt19937 engine(2);
  for (int i = 0; i < 200; ++i) {
    ASSERT_TRUE(path.to_strain(random_six(engine, 0.1)));
    EXPECT_NEAR(von_mises(path.response().stress), 200, 1e-9);
  }
}

TEST(Plastic, RandomStepsStayFiniteAndDissipate) {
  const std::array<Hardening, 3> kinds{LinearHardening{200, 2000}, VoceHardening{200, 100, 50, 0},
                                       TableHardening{{{0, 200}, {0.01, 260}, {0.03, 300}}}};
  std::mt19937 engine(1);
  for (const auto& kind : kinds)
    for (const double size : {1e-3, 1e-2}) {
      PointPath path(steel(kind, one_back_stress(20e3, 0)));
      for (int i = 0; i < 10'000; ++i)
        ASSERT_TRUE(path.to_strain(random_six(engine, size)));
      EXPECT_TRUE(std::isfinite(path.work));
      EXPECT_GE(path.least_plastic, 0);
    }
}

TEST(Plastic, RandomStepsOfThreeBackStressesStayFinite) {
  const BackStresses three{{BackStress{20e3, 100}, BackStress{200e3, 2000}, BackStress{2e3, 0}}, 3};
  std::mt19937 engine(1);
  for (const double size : {1e-3, 1e-2, 0.3}) {
    PointPath path(steel(VoceHardening{200, 100, 50, 0}, three));
    for (int i = 0; i < 10'000; ++i)
      ASSERT_TRUE(path.to_strain(random_six(engine, size)));
    EXPECT_TRUE(std::isfinite(path.work));
    EXPECT_GT(path.lost.plastic, 0);
  }
}

TEST(Plastic, SaysHowMuchOfABackStressAStepRecalls) {
  const auto law = steel(LinearHardening{200, 0}, one_back_stress(20e3, 100));
  PointPath path(law);
  const auto before = path.state();
  ASSERT_TRUE(path.pull(0.01));
  EXPECT_DOUBLE_EQ(recall_of_step(law, before, path.state()), 100 * path.p());
}

} // namespace
} // namespace rubato::material::plastic_test
