// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/plane_stress.hpp"

#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::plane_stress_test {
namespace {

using test::PointPath;

constexpr double young = 200e3;
const Plastic steel{young, 0.3, LinearHardening{200, 2000}, {}};
const MooneyRivlin rubber{0.4, 0.1, 50};

/// Stresses of the plane are 0 but along x; its strains yz and xz are held, as a plane has none.
bool pull_in_plane(PointPath& path, double strain) {
  return path.to_mixed({true, false, true, false, true, true}, strain * Strain6::Unit(0));
}

Strain6 in_plane(double xx, double yy, double xy) {
  Strain6 strain = Strain6::Zero();
  strain[0] = xx, strain[1] = yy, strain[3] = xy;
  return strain;
}

TEST(PlaneStress, ABarYieldsAsIn3d) {
  PointPath path(PlaneStress{steel});
  ASSERT_TRUE(pull_in_plane(path, 0.02));
  EXPECT_NEAR(path.response().stress[0], 237.623762, 5e-7);
  EXPECT_EQ(path.response().stress[2], 0);
}

TEST(PlaneStress, ASheetPulledBothWaysYieldsInOneStep) {
  PointPath path(PlaneStress{steel});
  ASSERT_TRUE(path.to_strain(in_plane(0.02, 0.02, 0)));
  EXPECT_NEAR(path.response().stress[0], 276.134122, 5e-7);
  EXPECT_NEAR(path.response().stress[1], 276.134122, 5e-7);
}

TEST(PlaneStress, OfElasticityIsItsClosedForm) {
  PointPath path(PlaneStress{make_elastic_point(young, 0.3)});
  ASSERT_TRUE(path.to_strain(in_plane(1e-3, 2e-3, 3e-3)));
  EXPECT_NEAR(path.response().stress[0], young / 0.91 * (1e-3 + 0.3 * 2e-3), 1e-11 * young);
  EXPECT_NEAR(path.response().stress[3], young / 2.6 * 3e-3, 1e-11 * young);
  EXPECT_NEAR(strain_across(path.state()), -0.3 / 0.7 * 3e-3, 1e-15);
}

TEST(PlaneStress, EqualsTheLawOfSpaceWithoutStressAcross) {
  std::mt19937 engine(2);
  const std::array<std::pair<SpaceLaw, double>, 2> laws{{{steel, 0.01}, {rubber, 0.2}}};
  for (const auto& [law, size] : laws) {
    PointPath plane(PlaneStress{law});
    PointPath space(std::visit([](const auto& one) { return PointLaw(one); }, law));
    for (int i = 0; i < 20; ++i) {
      auto strain = test::random_six(engine, size);
      strain[2] = strain[4] = strain[5] = 0;
      ASSERT_TRUE(plane.to_strain(strain));
      strain[2] = strain_across(plane.state());
      ASSERT_TRUE(space.to_strain(strain));
      EXPECT_LT((plane.response().stress - space.response().stress).norm(),
                1e-11 * space.response().stress.norm());
      EXPECT_NEAR(plane.response().stored, space.response().stored, 1e-10 * space.response().stored);
    }
  }
}

/// Strains that are rounding make stresses that are rounding of the shear modulus, not of the bulk modulus.
TEST(PlaneStress, LeavesNoStressOfTheBulkModulusAtRest) {
  for (const double bulk : {1.0, 200.0, 1e5}) {
    PointPath path(PlaneStress{MooneyRivlin{0.5, 0, bulk}});
    ASSERT_TRUE(path.to_strain(in_plane(2e-16, 1e-16, 1e-16)));
    EXPECT_LT(path.response().stress.norm(), 2e-15) << bulk;
    EXPECT_EQ(path.response().stress[2], 0);
  }
}

/// A sheet of rubber that is stretched to 4 times its length in one step, and back.
TEST(PlaneStress, FindsTheThicknessOfLargeSteps) {
  const double strain = 0.5 * (16 - 1);
  for (const double bulk : {1.0, 1e3, 1e5}) {
    PointPath path(PlaneStress{MooneyRivlin{0.5, 0, bulk}});
    ASSERT_TRUE(path.to_strain(in_plane(strain, strain, 0))) << bulk;
    EXPECT_GT(1 + 2 * strain_across(path.state()), 0);
    ASSERT_TRUE(path.to_strain(in_plane(-0.4, -0.4, 0))) << bulk;
    ASSERT_TRUE(path.to_strain(in_plane(0, 0, 0))) << bulk;
    EXPECT_NEAR(strain_across(path.state()), 0, 1e-12);
  }
}

TEST(PlaneStress, RandomStepsHaveAnEnd) {
  std::mt19937 engine(9);
  const BackStresses three{{BackStress{20e3, 100}, BackStress{200e3, 2000}, BackStress{2e3, 0}}, 3};
  const std::array<Plastic, 3> laws{steel, Plastic{young, 0.3, LinearHardening{200, 0}, {}},
                                    Plastic{young, 0.3, VoceHardening{200, 100, 50, 0}, three}};
  for (const auto& law : laws)
    for (const double size : {1e-3, 1e-2, 0.2}) {
      PointPath path(PlaneStress{law});
      for (int i = 0; i < 3000; ++i) {
        auto strain = test::random_six(engine, size);
        strain[4] = strain[5] = 0;
        ASSERT_TRUE(path.to_strain(strain)) << size << ' ' << i;
      }
      EXPECT_TRUE(std::isfinite(path.work));
    }
}

TEST(PlaneStress, FailsWhereTheLawDoes) {
  PointPath path(PlaneStress{rubber});
  EXPECT_FALSE(path.to_strain(in_plane(-0.6, 0, 0)));
}

} // namespace
} // namespace rubato::material::plane_stress_test
