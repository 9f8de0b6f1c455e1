// SPDX-License-Identifier: LGPL-3.0-or-later
// Which faces of a surface that touches itself may meet, and which of two is the slave.
#include "rubato/contact/self_pairs.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;

/// A line of segments with its places.
struct Line {
  mesh::Mesh mesh;
  Surface surface;
  std::vector<Vector3d> x;
};

/// Adds segments from place to place, their normals to the right of the way; closed: the last leads to the
/// first.
void add_way(const std::vector<Vector3d>& places, bool closed, std::vector<Face>& faces, mesh::Mesh& mesh) {
  const auto first = mesh.node_count();
  mesh.points.insert(mesh.points.end(), places.begin(), places.end());
  const auto count = static_cast<mesh::NodeIndex>(places.size());
  for (mesh::NodeIndex i = 0; i + (closed ? 0 : 1) < count; ++i) {
    Face face;
    face.node_count = 2;
    face.nodes = {first + i, first + (i + 1) % count};
    faces.push_back(face);
  }
}

Line line_of(mesh::Mesh mesh, std::vector<Face> faces) {
  Line line;
  line.mesh = std::move(mesh);
  line.surface = make_surface(line.mesh, std::move(faces));
  line.x = line.mesh.points;
  return line;
}

/// A circle of that radius; the inside of a ring goes round clockwise.
std::vector<Vector3d> circle(double radius, int count, bool inside) {
  std::vector<Vector3d> places;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * pi * i / count * (inside ? -1 : 1);
    places.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return places;
}

Line ring(int count = 24) {
  Line line;
  std::vector<Face> faces;
  add_way(circle(0.95, count, true), true, faces, line.mesh);
  add_way(circle(1, count, false), true, faces, line.mesh);
  return line_of(std::move(line.mesh), std::move(faces));
}

Vector3d centre(const Line& line, int face) {
  const auto& nodes = line.surface.faces[static_cast<std::size_t>(face)].nodes;
  return (line.mesh.points[static_cast<std::size_t>(nodes[0])] +
          line.mesh.points[static_cast<std::size_t>(nodes[1])]) /
         2;
}

bool is_inside(const Line& line, int face) {
  return centre(line, face).norm() < 0.96;
}

/// The ring's inside flattened along the direction of that angle; its wall stays as thick as it is.
std::vector<Vector3d> flattened(const Line& line, double angle) {
  const Vector3d along(std::cos(angle), std::sin(angle), 0);
  std::vector<Vector3d> x;
  for (const auto& point : line.mesh.points) {
    const Vector3d radial = point.normalized(), inside = 0.95 * radial;
    x.push_back(inside - 0.95 * along.dot(inside) * along + (point - inside));
  }
  return x;
}

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
} // namespace rubato::contact
