// SPDX-License-Identifier: LGPL-3.0-or-later
// Which faces of a surface that touches itself may meet, and which of two is the slave.
#include "rubato/contact/self_pairs.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "unit/contact/flattened_ring.hpp"
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace rubato::contact::self_pairs_test {
namespace {

using Eigen::Vector3d;
using test::centre;
using test::flattened;
using test::is_inside;
using test::Line;
using test::ring;
constexpr double pi = std::numbers::pi;

template <class Visit> void for_each_pair(const Line& line, const Visit& visit) {
  const auto count = static_cast<int>(line.surface.faces.size());
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b)
      visit(a, b);
}

TEST(FacesOfASurfaceThatTouchesItself, AreNeverSlavesOfEachOther) {
  const auto line = ring();
  SelfPairs pairs(line.surface, line.x, 0.3);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    auto x = flattened(line, 10 * any(random));
    for (auto& point : x)
      point += 0.05 * Vector3d(any(random), any(random), 0);
    pairs.update(x);
    for_each_pair(line, [&](int a, int b) {
      EXPECT_FALSE(pairs.may_pair(a, b) && pairs.may_pair(b, a)) << a << ", " << b;
      EXPECT_EQ(pairs.may_meet(a, b), pairs.may_pair(a, b) || pairs.may_pair(b, a)) << a << ", " << b;
    });
  }
}

TEST(FacesOfASurfaceThatTouchesItself, DoNotMeetTheirNeighbours) {
  const auto line = ring();
  const SelfPairs pairs(line.surface, line.x, 0.3);
  for (int i = 0; i < 24; ++i) {
    EXPECT_FALSE(pairs.may_meet(i, i));
    EXPECT_FALSE(pairs.may_meet(i, (i + 1) % 24));
    EXPECT_TRUE(pairs.may_meet(i, (i + 12) % 24));
  }
}

/// The wall of the ring is thinner than its faces are long.
TEST(FacesOfASurfaceThatTouchesItself, DoNotMeetThroughTheBody) {
  const auto line = ring();
  const SelfPairs pairs(line.surface, line.x, 0.3);
  for_each_pair(line, [&](int a, int b) {
    if (is_inside(line, a) && !is_inside(line, b) && (centre(line, a) - centre(line, b)).norm() < 0.3) {
      EXPECT_FALSE(pairs.may_meet(a, b)) << a << ", " << b;
    }
  });
}

TEST(ARingPressedFlatAlongAnAxis, HasItsUpperHalfAsSlave) {
  const auto line = ring();
  SelfPairs pairs(line.surface, line.x, 0.3);
  for (const int axis : {0, 1}) {
    pairs.update(flattened(line, axis * pi / 2));
    for_each_pair(line, [&](int a, int b) {
      const double one = centre(line, a)[axis], other = centre(line, b)[axis];
      if (is_inside(line, a) && is_inside(line, b) && one * other < 0 && pairs.may_meet(a, b)) {
        EXPECT_EQ(pairs.may_pair(a, b), one > other) << axis << ": " << a << ", " << b;
      }
    });
  }
}

/// The order does not change with the direction as long as it is nearer to that axis, nor on the diagonal.
TEST(ARingPressedFlatAtAnAngle, HasOneHalfAsSlave) {
  const auto line = ring(48);
  for (const double angle : {0.1, 0.3, pi / 4, 1.2, 1.5}) {
    SelfPairs pairs(line.surface, line.x, 0.2);
    const auto x = flattened(line, angle);
    pairs.update(x);
    const Vector3d along(std::cos(angle), std::sin(angle), 0);
    for_each_pair(line, [&](int a, int b) {
      if (!is_inside(line, a) || !is_inside(line, b) || !pairs.may_meet(a, b))
        return;
      const Vector3d apart = centre(line, a) - centre(line, b);
      if (apart.normalized().dot(along) > 0.9) {
        EXPECT_TRUE(pairs.may_pair(a, b)) << angle << ": " << a << ", " << b;
      }
    });
  }
}

} // namespace
} // namespace rubato::contact::self_pairs_test
