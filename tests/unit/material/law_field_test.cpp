// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/law_field.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include <cmath>
#include <numbers>

namespace rubato::material::law_field_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using study::Physics;

study::Material timber() {
  study::Material material;
  material.name = "wood";
  material.law = study::LawKind::orthotropic;
  auto& o = material.orthotropy;
  o.young_x = 11600, o.young_y = 900, o.young_z = 500;
  o.poisson_xy = 0.37, o.poisson_yz = 0.43, o.poisson_xz = 0.47;
  o.shear_xy = 750, o.shear_yz = 39, o.shear_xz = 720;
  return material;
}

Matrix3d matrix_of(const FullStress& v, double shear) {
  Matrix3d m;
  m << v[0], shear * v[3], shear * v[5], shear * v[3], v[1], shear * v[4], shear * v[5], shear * v[4], v[2];
  return m;
}

FullStress strain_of(const Matrix3d& m) {
  FullStress v;
  v << m(0, 0), m(1, 1), m(2, 2), 2 * m(0, 1), 2 * m(1, 2), 2 * m(0, 2);
  return v;
}

TEST(ALawField, IsNoneOfAMaterialThatIsTheSameEverywhere) {
  EXPECT_EQ(law_field(timber(), Physics::solid), nullptr);
}

TEST(ALawField, HasTheNumbersOfEachPlace) {
  study::Material material;
  material.name = "steel";
  material.poisson = 0.25;
  material.in_place["young"] = study::Formula{"10+x*y"};
  material.in_place["density"] = Profile{2, {{0, 1}, {3, 5}, LinearTable::Outside::constant}};
  const auto field = law_field(material, Physics::solid);
  ASSERT_NE(field, nullptr);
  EXPECT_TRUE(field->varies_tangent());
  EXPECT_TRUE(field->varies_density());
  EXPECT_EQ(std::get<LinearElastic>(field->at({2, 3, 0.5})), (LinearElastic{16, 0.25, 4}));
  EXPECT_EQ(field->density_at({0, 0, 9}), 5);
  material.in_place.erase("young");
  EXPECT_FALSE(law_field(material, Physics::solid)->varies_tangent());
}

TEST(CylindricalAxesOfALaw, InThePlaneAreThoseTurnedByThePolarAngle) {
  auto material = timber();
  material.orthotropy.cylindrical = study::CylindricalAxes{{1, 2, 0}, {0, 0, 1}};
  material.orthotropy.angle_z = 12;
  for (const auto physics : {Physics::plane_stress, Physics::plane_strain})
    for (const double angle : {0., 30., 90., 200., -60.}) {
      auto expected = material.orthotropy;
      expected.cylindrical.reset();
      expected.angle_z += angle;
      const double radians = angle * std::numbers::pi / 180;
      const auto law =
          law_field(material, physics)->at({1 + 3 * std::cos(radians), 2 + 3 * std::sin(radians), 0});
      const Tangent wanted = tangent(make_orthotropic(expected, 0), physics);
      EXPECT_LT((tangent(law, physics) - wanted).norm(), 1e-13 * wanted.norm()) << angle;
    }
}

/// σ = R D[Rᵀ ε R] Rᵀ, with tensors and a finite rotation, shears included.
TEST(CylindricalAxesOfALaw, InSpaceTurnStrainsAndStressesAsTensors) {
  auto material = timber();
  const Vector3d along = Vector3d(1, -2, 2) / 3.;
  material.orthotropy.cylindrical = study::CylindricalAxes{{0.5, 1, -2}, {2, -4, 4}};
  material.orthotropy.angle_x = 35;
  const Vector3d place(3, 1, 4);
  const auto law = law_field(material, Physics::solid)->at(place);

  Vector3d radial = place - Vector3d(0.5, 1, -2);
  radial = (radial - radial.dot(along) * along).normalized();
  Matrix3d axes;
  axes << radial, along.cross(radial), along;
  axes = Eigen::AngleAxisd(35 * std::numbers::pi / 180, radial).toRotationMatrix() * axes;
  auto plain = timber().orthotropy;
  const auto own = make_orthotropic(plain, 0);
  Matrix3d strain;
  strain << 3, 0.5, -1, 0.5, -2, 0.7, -1, 0.7, 1;
  const FullStress own_stress = own.stiffness * strain_of(axes.transpose() * strain * axes);
  const Matrix3d expected = axes * matrix_of(own_stress, 1) * axes.transpose();
  const FullStress found = stress(law, Physics::solid, strain_of(strain));
  EXPECT_LT((matrix_of(found, 1) - expected).norm(), 1e-13 * expected.norm());
}

TEST(ALawField, RefusesWhatIsNoMaterialAtAPlace) {
  auto material = timber();
  material.in_place["poisson_xy"] = study::Formula{"x"};
  const auto field = law_field(material, Physics::solid);
  field->at({0.3, 0, 0});
  const auto fault = test::fault_of([&] { field->at({4, 0, 0}); });
  EXPECT_NE(
      fault.find("materials.wood.poisson_xy: at x = 4, y = 0, z = 0: found 4, expected a number between"),
      std::string::npos)
      << fault;
  material.orthotropy.cylindrical = study::CylindricalAxes{};
  EXPECT_NE(test::fault_of([&] {
              law_field(material, Physics::solid)->at({0, 0, 1});
            }).find("on the line"),
            std::string::npos);
}

} // namespace
} // namespace rubato::material::law_field_test
