// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/segments.hpp"
#include "rubato/contact/mortar/subfacets.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace rubato::contact::mortar::segments_2d_test {
namespace {

using Eigen::Vector3d;

FaceCoordinates line(const Vector3d& a, const Vector3d& b) {
  FaceCoordinates x(3, 2);
  x << a, b;
  return x;
}

SlaveFace slave_line(const Vector3d& a, const Vector3d& b, const Vector3d& normal_a,
                     const Vector3d& normal_b) {
  return {CellType::seg2, line(a, b), line(a, b), line(normal_a, normal_b)};
}

OverlapPoints overlap_of(const SlaveFace& slave, const FaceCoordinates& master, const Reach& reach) {
  OverlapPoints overlap;
  append_line_overlap(slave, subfacets(CellType::seg2).front(), {}, {CellType::seg2, master}, reach, overlap);
  return overlap;
}

constexpr Reach everywhere{1e3, 1e3};

/// A hook that comes over a cam: the master is below and behind a face that looks ahead. Lines along the
/// normals of its ends cross between the two.
TEST(LineOverlaps, LeaveOutAMasterThatLinesAlongNormalsMissBeyondTheirCrossing) {
  const auto slave =
      slave_line({32.76, 0.2, 0}, {32.76, 0.345, 0}, Vector3d(0.892, -0.452, 0).normalized(), {1, 0, 0});
  for (double x = 31.5; x < 32.7; x += 0.1)
    EXPECT_TRUE(overlap_of(slave, line({x + 0.2, -0.5, 0}, {x, -0.5, 0}), everywhere).points.empty()) << x;
}

/// Lines along the normals cross 0.5 behind the slave; those of its middle go on.
TEST(LineOverlaps, MeetAMasterBehindTheCrossingOfNormals) {
  const auto slave = slave_line({-0.5, 0, 0}, {0.5, 0, 0}, Vector3d(-1, -1, 0).normalized(),
                                Vector3d(1, -1, 0).normalized());
  for (const double half : {0.1, 0.4, 0.6, 2.}) {
    double length = 0;
    for (const auto& point : overlap_of(slave, line({half, 1, 0}, {-half, 1, 0}), everywhere).points) {
      length += point.weight;
      EXPECT_NEAR(point.distance, -1, 1e-12);
      EXPECT_NEAR(point.eta[0] * half, -0.5 * point.xi[0], 1e-12);
    }
    EXPECT_NEAR(length, std::min(1., 2 * half), 1e-12) << half;
  }
}

/// Whatever the lines are: a point of the master is where the direction of projection says, which is the
/// interpolated normal or that of the middle.
TEST(LineOverlaps, FindMastersWhereTheDirectionOfProjectionSays) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> anywhere(-1, 1), tilt(-0.9, 0.9);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto normal = [&] {
      return Vector3d(std::sin(tilt(random)), -std::cos(tilt(random)), 0).normalized();
    };
    const auto slave = slave_line({-0.5, 0, 0}, {0.5, 0, 0}, normal(), normal());
    const auto place = [&] { return Vector3d(2 * anywhere(random), 2 * anywhere(random), 0); };
    const auto master = line(place(), place());
    for (const auto& point : overlap_of(slave, master, everywhere).points) {
      ++met;
      const auto at = [](const FaceCoordinates& nodes, double xi) -> Vector3d {
        return 0.5 * (1 - xi) * nodes.col(0) + 0.5 * (1 + xi) * nodes.col(1);
      };
      const Vector3d apart = at(master, point.eta[0]) - at(slave.x, point.xi[0]);
      const auto missed_by = [&](double xi) {
        const Vector3d direction = at(slave.normals, xi).normalized();
        return (apart - apart.dot(direction) * direction).norm();
      };
      EXPECT_LT(std::min(missed_by(point.xi[0]), missed_by(0)), 1e-6) << i;
      EXPECT_LE(std::abs(point.eta[0]), 1 + 1e-6) << i;
    }
  }
  EXPECT_GT(met, 1000);
}

} // namespace
} // namespace rubato::contact::mortar::segments_2d_test
