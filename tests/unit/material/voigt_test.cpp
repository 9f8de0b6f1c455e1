// SPDX-License-Identifier: LGPL-3.0-or-later
// Stresses of every physics among all six components.
#include "rubato/material/voigt.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace rubato::material::voigt_test {
namespace {

using study::Physics;

FullStress stress(double xx, double yy, double zz, double xy, double yz, double xz) {
  return (FullStress() << xx, yy, zz, xy, yz, xz).finished();
}

TEST(VoigtVectors, HaveTheLengthOfTheirPhysics) {
  EXPECT_EQ(strain_size(Physics::solid), 6);
  EXPECT_EQ(strain_size(Physics::axisymmetric), 4);
  EXPECT_EQ(strain_size(Physics::plane_strain), 3);
  EXPECT_EQ(strain_size(Physics::plane_stress), 3);
  EXPECT_EQ(direct_count(Physics::solid), 3);
  EXPECT_EQ(direct_count(Physics::axisymmetric), 3);
  EXPECT_EQ(direct_count(Physics::plane_strain), 2);
  EXPECT_EQ(direct_count(Physics::plane_stress), 2);
}

TEST(VoigtVectors, HaveTheirPlacesAmongAllSix) {
  EXPECT_EQ(with_zeros(Physics::solid, (Voigt(6) << 1, 2, 3, 4, 5, 6).finished()), stress(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(with_zeros(Physics::axisymmetric, (Voigt(4) << 1, 2, 3, 4).finished()), stress(1, 2, 3, 4, 0, 0));
  for (const auto plane : {Physics::plane_strain, Physics::plane_stress})
    EXPECT_EQ(with_zeros(plane, (Voigt(3) << 1, 2, 4).finished()), stress(1, 2, 0, 4, 0, 0));
}

TEST(VonMisesStress, IsThatOfAPulledBarAndOfShear) {
  EXPECT_DOUBLE_EQ(von_mises(stress(-7, 0, 0, 0, 0, 0)), 7);
  for (int shear = 3; shear < 6; ++shear) {
    FullStress pure = FullStress::Zero();
    pure[shear] = -2;
    EXPECT_DOUBLE_EQ(von_mises(pure), 2 * std::sqrt(3.0)) << shear;
  }
}

TEST(VonMisesStress, DoesNotSeePressure) {
  const auto some = stress(1, -2, 4, 3, -1, 2);
  EXPECT_NEAR(von_mises(some + stress(100, 100, 100, 0, 0, 0)), von_mises(some), 1e-12);
  EXPECT_EQ(von_mises(stress(5, 5, 5, 0, 0, 0)), 0);
}

TEST(VonMisesStress, IsTheSameInEveryFrame) {
  const auto some = stress(1, -2, 4, 3, -1, 2);
  Eigen::Matrix3d tensor;
  tensor << 1, 3, 2, 3, -2, -1, 2, -1, 4;
  const Eigen::Matrix3d q = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d turned = q * tensor * q.transpose();
  EXPECT_NEAR(
      von_mises(stress(turned(0, 0), turned(1, 1), turned(2, 2), turned(0, 1), turned(1, 2), turned(0, 2))),
      von_mises(some), 1e-12);
}

} // namespace
} // namespace rubato::material::voigt_test
