// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/elastic_point.hpp"

#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::elastic_point_test {
namespace {

using test::PointPath;

/// St Venant and Kirchhoff's law: P/E = λ (λ² − 1)/2.
TEST(ElasticPoint, StretchedWithGreenLagrangesStrainGivesItsClosedForm) {
  constexpr double stretch = 1.5;
  PointPath path(make_elastic_point(200e3, 0.3));
  ASSERT_TRUE(path.pull(0.5 * (stretch * stretch - 1)));
  EXPECT_NEAR(stretch * path.response().stress[0], 0.9375 * 200e3, 1e-9);
}

TEST(ElasticPoint, HasTheStiffnessOfAnOrthotropicLaw) {
  study::Orthotropy o;
  o.young_x = 150, o.young_y = 10, o.poisson_xy = 0.3, o.shear_xy = 5;
  for (const auto& [angle, young] : {std::pair(30.0, 21.390374), std::pair(45.0, 13.215859)}) {
    o.angle_z = angle;
    PointPath path(make_elastic_point(make_orthotropic(o, 0)));
    ASSERT_TRUE(path.to_mixed({}, Stress6::Unit(0)));
    EXPECT_NEAR(1 / path.strain()[0], young, 5e-7);
  }
}

} // namespace
} // namespace rubato::material::elastic_point_test
