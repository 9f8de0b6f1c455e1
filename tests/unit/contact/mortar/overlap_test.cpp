// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/clipping.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <algorithm>
#include <random>

namespace rubato::overlap_test {
namespace {

using namespace contact::mortar;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Corners = std::vector<Vector2d>;

double cross(const Vector2d& a, const Vector2d& b) {
  return a[0] * b[1] - a[1] * b[0];
}

bool is_inside(const Vector2d& p, const Corners& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]) < -1e-14)
      return false;
  return true;
}

void add_crossings(const Corners& one, const Corners& other, Corners& corners) {
  for (std::size_t i = 0; i < one.size(); ++i)
    for (std::size_t j = 0; j < other.size(); ++j) {
      const Vector2d a = one[i], along = one[(i + 1) % one.size()] - a;
      const Vector2d b = other[j], across = other[(j + 1) % other.size()] - b;
      const double determinant = cross(along, across);
      const double s = cross(b - a, across) / determinant, t = cross(b - a, along) / determinant;
      if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
        corners.push_back(a + s * along);
    }
}

/// The area of the intersection of two convex polygons from its corners, whichever way they are found:
/// corners of one in the other and crossings of edges, sorted around their mean.
double intersection_area(const Corners& one, const Corners& other) {
  Corners corners;
  std::ranges::copy_if(one, std::back_inserter(corners), [&](const auto& p) { return is_inside(p, other); });
  std::ranges::copy_if(other, std::back_inserter(corners), [&](const auto& p) { return is_inside(p, one); });
  add_crossings(one, other, corners);
  Vector2d middle = Vector2d::Zero();
  for (const auto& corner : corners)
    middle += corner / static_cast<double>(corners.size());
  std::ranges::sort(corners, {},
                    [&](const Vector2d& p) { return std::atan2(p[1] - middle[1], p[0] - middle[0]); });
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    area += 0.5 * cross(corners[i] - middle, corners[(i + 1) % corners.size()] - middle);
  return area;
}

Polygon polygon_of(const Corners& corners) {
  Polygon polygon;
  for (const auto& corner : corners)
    polygon.add(corner);
  return polygon;
}

/// A convex polygon with corners on an ellipse, as slim as the second radius.
Corners random_polygon(std::mt19937& random, std::size_t count, const Vector2d& middle, double slimness) {
  std::uniform_real_distribution<double> angle(0, 6.28);
  std::vector<double> angles(count);
  std::ranges::generate(angles, [&] { return angle(random); });
  std::ranges::sort(angles);
  const double turn = angle(random);
  Corners corners;
  for (const double at : angles)
    corners.push_back(middle + Eigen::Rotation2Dd(turn) * Vector2d(std::cos(at), slimness * std::sin(at)));
  return corners;
}

TEST(Clipping, GivesTheAreaOfTheIntersectionOfConvexPolygons) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  int overlapping = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double slimness = trial % 3 == 0 ? 1e-4 : 1;
    const auto one = random_polygon(random, 3 + trial % 2, Vector2d::Zero(), slimness);
    const auto other = random_polygon(random, 3 + trial / 2 % 2, {unit(random), unit(random)}, 1);
    const auto part = clip(polygon_of(one), polygon_of(other));
    const double expected = intersection_area(one, other);
    EXPECT_NEAR(signed_area(part), expected, 1e-9 * slimness) << trial;
    std::array<Triangle, Polygon::capacity> triangles;
    double sum = 0;
    for (std::size_t t = 0, count = fan(part, triangles); t < count; ++t)
      sum += triangles[t].area;
    EXPECT_NEAR(sum, signed_area(part), 1e-14);
    overlapping += expected > 1e-3 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 500);
}

TEST(Clipping, KeepsWhatTouchesAnEdgeFromInside) {
  const Corners square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_DOUBLE_EQ(signed_area(clip(polygon_of(square), polygon_of(square))), 1);
  const Corners beside{{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  EXPECT_DOUBLE_EQ(signed_area(clip(polygon_of(square), polygon_of(beside))), 0);
}

TEST(Clipping, CountsTrianglesOutsideAFoldedPolygonNegative) {
  const Corners folded{{0, 0}, {4, 0}, {4, 1}, {0.1, 0.5}, {4, 4}, {0, 4}};
  std::array<Triangle, Polygon::capacity> triangles;
  const auto count = fan(polygon_of(folded), triangles);
  double sum = 0, least = 0;
  for (std::size_t t = 0; t < count; ++t) {
    sum += triangles[t].area;
    least = std::min(least, triangles[t].area);
  }
  EXPECT_NEAR(sum, signed_area(polygon_of(folded)), 1e-14);
  EXPECT_LT(least, 0);
}

/// A flat slave face below which a random master face lies, skewed, moved and tilted.
struct FacePair {
  test::TwoSurfaces two;
  Corners slave, master; ///< in the slave's plane, counter-clockwise
};

FacePair random_pair(CellType slave, CellType master, double tilt, std::mt19937& random) {
  std::uniform_real_distribution<double> noise(-0.2, 0.2), shift(-1.2, 1.2);
  const auto corners_of = [&](CellType type) {
    std::array<Vector2d, 4> corners{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    for (auto& corner : corners)
      corner += Vector2d(noise(random), noise(random));
    if (cell::topology(type).corner_count == 3) // else edges of quadratic triangles would be curved
      corners[3] = corners[1] + corners[2] - corners[0];
    return corners;
  };
  const auto bilinear = [](const std::array<Vector2d, 4>& c, double s, double t) -> Vector2d {
    return (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + (1 - s) * t * c[2] + s * t * c[3];
  };
  const auto low = corners_of(master), high = corners_of(slave);
  const Eigen::AngleAxisd turn(tilt, Vector3d(noise(random), noise(random), 0).normalized());
  const Vector2d moved(shift(random), shift(random));
  FacePair pair;
  pair.two = test::two_surfaces(
      {.type = slave},
      [&](double s, double t) {
        const Vector2d p = bilinear(high, s, t);
        return Vector3d(p[0], p[1], 0);
      },
      {.type = master},
      [&](double s, double t) {
        const Vector2d p = bilinear(low, s, t) - Vector2d(0.5, 0.5);
        const Vector3d x = turn * Vector3d(p[0], p[1], 0);
        return Vector3d(x[0] + 0.5 + moved[0], x[1] + 0.5 + moved[1], x[2]);
      });
  for (auto* surface : {&pair.two.slave, &pair.two.master}) {
    auto faces = surface->faces;
    faces.resize(1); // of two triangles the first
    *surface = contact::make_surface(pair.two.mesh, faces);
  }
  const auto flat = [&](const contact::Face& face) {
    Corners corners;
    for (int i = 0; i < cell::topology(face.type).corner_count; ++i)
      corners.emplace_back(
          pair.two.mesh.points[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])].head<2>());
    return corners;
  };
  pair.slave = flat(pair.two.slave.faces[0]);
  std::ranges::reverse(pair.slave);
  pair.master = flat(pair.two.master.faces[0]);
  return pair;
}

TEST(Overlaps, OfRandomPairsOfFacesHaveTheAreaOfTheirIntersectionAndConsistentOperators) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> tilt(0, 80 * 3.14159265 / 180);
  int overlapping = 0, tiny = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const auto slave = test::solid_types[static_cast<std::size_t>(trial) % 6];
    const auto master = test::solid_types[static_cast<std::size_t>(trial) / 6 % 6];
    const auto pair = random_pair(slave, master, tilt(random), random);
    const double expected = intersection_area(pair.slave, pair.master);
    const auto operators = pair.two.operators({.reach = 10});
    EXPECT_NEAR(operators.covered_area, expected, 1e-9) << trial;
    EXPECT_EQ(operators.lost_area, 0);
    for (const auto& node : operators.nodes) {
      EXPECT_GE(node.weight, 0);
      if (node.kept()) {
        EXPECT_LE(std::abs(node.stencil.weights.sum()), 1e-12 * node.stencil.weights.lpNorm<1>()) << trial;
      }
    }
    overlapping += expected > 1e-6 ? 1 : 0;
    tiny += expected > 0 && expected < 1e-2 ? 1 : 0;
  }
  EXPECT_GT(overlapping, 800);
  EXPECT_GT(tiny, 20);
}

TEST(Overlaps, OfFacesThatLookAwayOrStandOnEdgeAreNone) {
  for (const double degrees : {85., 95., 180.}) {
    const Eigen::AngleAxisd turn(degrees * 3.14159265358979 / 180, Vector3d::UnitX());
    const auto two = test::two_surfaces(
        {.type = CellType::quad4}, [](double s, double t) { return Vector3d(s, t, 0); },
        {.type = CellType::quad4},
        [&](double s, double t) { return Vector3d(turn * Vector3d(s, t - 0.5, 0) + Vector3d(0, 0.5, 0)); });
    EXPECT_EQ(two.operators({.reach = 10}).covered_area, 0) << degrees;
  }
}

TEST(Overlaps, OutOfReachAreNone) {
  for (const auto type : {CellType::seg2, CellType::seg3, CellType::quad4, CellType::tria6}) {
    const int up = cell::topology(type).dimension;
    for (const double side : {-1., 1.}) {
      const auto at = [&](double height) {
        return test::two_surfaces(
            {.type = type},
            [&](double s, double t) -> Vector3d {
              return up == 1 ? Vector3d(s, height, 0) : Vector3d(s, t, height);
            },
            {.type = type},
            [&](double s, double t) -> Vector3d { return up == 1 ? Vector3d(s, 0, 0) : Vector3d(s, t, 0); });
      };
      EXPECT_EQ(at(side * 0.31).operators({.reach = 0.3}).covered_area, 0);
      EXPECT_NEAR(at(side * 0.29).operators({.reach = 0.3}).covered_area, 1, 1e-14);
    }
  }
}

} // namespace
} // namespace rubato::overlap_test
