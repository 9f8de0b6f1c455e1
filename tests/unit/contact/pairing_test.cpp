// SPDX-License-Identifier: LGPL-3.0-or-later
// Which face each point gets: the search by nodes against a projection on every face of the master.
#include "rubato/contact/pairing.hpp"
#include "rubato/contact/point_tree.hpp"
#include "rubato/core/tolerances.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace rubato::contact::pairing_test {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> scattered(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-1, 1);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double x = place(random), y = place(random);
    points.emplace_back(x, y, place(random));
  }
  return points;
}

TEST(PointTree, FindsWhatAComparisonWithEveryPointFinds) {
  for (const int count : {1, 7, 400}) {
    const auto points = scattered(count, 1);
    const PointTree tree(points);
    for (const auto& x : scattered(100, 2)) {
      const auto apart = [&](const Vector3d& point) { return (point - x).squaredNorm(); };
      const auto nearest = std::ranges::min_element(points, {}, apart);
      const auto found = tree.nearest(x);
      EXPECT_EQ(found.index, static_cast<std::size_t>(nearest - points.begin()));
      EXPECT_NEAR(found.squared_distance, apart(*nearest), 1e-15);
      std::vector<std::uint32_t> within;
      tree.append_within(x, 0.5, within);
      std::ranges::sort(within);
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < points.size(); ++i)
        if (apart(points[i]) < 0.25)
          expected.push_back(i);
      EXPECT_EQ(within, expected);
    }
  }
}

TEST(PointTree, AppendsToWhatIsThere) {
  const std::vector<Vector3d> points{{0, 0, 0}, {3, 0, 0}};
  const PointTree tree(points);
  std::vector<std::uint32_t> found{7};
  tree.append_within({2.9, 0, 0}, 1, found);
  EXPECT_EQ(found, (std::vector<std::uint32_t>{7, 1}));
}

/// A plate above a longer one, both bent by `moved`.
const std::string plates = R"(
mesh:
  generate:
    - {name: lower, box: {from: [-1, -0.2, -1], to: [1, 0, 1]}, divisions: [6, 1, 5], sides: {top: below, bottom: ground}}
    - {name: upper, box: {from: [-0.9, 0, -1.3], to: [1.4, 0.2, 0.8]}, divisions: [5, 1, 7], sides: {bottom: above, top: roof}}
physics: solid
materials: {rubber: {young: 1e6, poisson: 0.3}}
supports: [{on: ground, fix: [x, y, z]}, {on: roof, fix: [x, y, z]}]
contact: {rest: {master: below, slave: above, integration: nodes}}
time: {scheme: static, step: 1, end: 1}
)";

/// A hump of the lower plate, and the upper one a little above or in it.
Eigen::VectorXd moved(const test::ModelParts& model, double amount) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    const double hump = -0.3 * (x[0] * x[0] + 0.5 * x[2] * x[2] * x[2]);
    const bool upper = model.zones.front().slave.position_of(node) >= 0;
    u[model.dofs.dof(node, 1)] = hump + (upper ? amount * std::sin(3 * x[0] + x[2]) : 0.0);
    u[model.dofs.dof(node, 2)] = 0.05 * amount * x[0];
  }
  return u;
}

/// How far the point is from the place it has on that face, and whether it is over the face.
struct Fit {
  double distance = 0;
  bool inside = false;
};

Fit fit_on(const Zone& zone, int face, const Vector3d& x, const std::vector<Vector3d>& master) {
  const auto pair = pair_on(zone, face, x, master);
  const auto& of_zone = zone.master.faces[static_cast<std::size_t>(face)];
  const auto nodes = values_of(of_zone, master);
  return {(x - face_position(of_zone.type, nodes, pair.projection.clamped)).norm(), pair.projection.inside()};
}

std::vector<Vector3d> master_of(const Zone& zone, const Configuration& configuration) {
  std::vector<Vector3d> master;
  for (const auto node : zone.master.nodes)
    master.push_back(configuration.position(node));
  return master;
}

class PairsOn : public testing::TestWithParam<const char*> {
protected:
  static test::BuiltModel model_of_plates() {
    return test::model_of(plates,
                          {{"mesh.generate.0.cells", GetParam()}, {"mesh.generate.1.cells", GetParam()}});
  }
};

TEST_P(PairsOn, AreWithTheNearestFaceOfAllThatHoldTheProjection) {
  const auto model = model_of_plates();
  const auto& zone = model.zones.front();
  int paired = 0, unpaired = 0;
  for (const double amount : {0.02, -0.05, 0.1}) {
    const auto u = moved(model, amount);
    const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
    const auto master = master_of(zone, configuration);
    const auto pairs = find_pairs(zone, configuration);
    ASSERT_EQ(pairs.size(), zone.points.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto x = position(zone.points[i], configuration);
      Fit best{INFINITY, false};
      for (int face = 0; face < static_cast<int>(zone.master.faces.size()); ++face)
        if (const auto fit = fit_on(zone, face, x, master); fit.inside && fit.distance < best.distance)
          best = fit;
      if (!pairs[i].paired()) {
        ++unpaired;
        EXPECT_FALSE(best.inside) << "point " << i;
        continue;
      }
      ++paired;
      const auto found = fit_on(zone, pairs[i].master_face, x, master);
      EXPECT_EQ(found.inside, best.inside) << "point " << i;
      const bool is_triangle =
          cell::topology(zone.master.faces[static_cast<std::size_t>(pairs[i].master_face)].type)
              .corner_count == 3;
      EXPECT_LE(pairs[i].projection.overshoot, is_triangle ? 0.25 : 0.5);
      if (best.inside) {
        EXPECT_NEAR(found.distance, best.distance, 1e-9) << "point " << i;
      }
    }
  }
  EXPECT_GT(paired, 50);
  EXPECT_GT(unpaired, 10) << "the upper plate is to reach beyond the lower one";
}

TEST_P(PairsOn, AreWithTheNearestNodeOfTheFaceWhenPairsAreNodal) {
  auto model = test::model_of(plates, {{"mesh.generate.0.cells", GetParam()},
                                       {"mesh.generate.1.cells", GetParam()},
                                       {"contact.rest.method", "nodal_lagrange"},
                                       {"contact.rest.nodal_pairs", "true"}});
  const auto& zone = model.zones.front();
  const auto u = moved(model, 0.05);
  const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
  const auto master = master_of(zone, configuration);
  const auto pairs = find_pairs(zone, configuration);
  int paired = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!pairs[i].paired())
      continue;
    ++paired;
    const auto x = position(zone.points[i], configuration);
    const auto& face = zone.master.faces[static_cast<std::size_t>(pairs[i].master_face)];
    const auto nodes = values_of(face, master);
    double least = INFINITY;
    for (int node = 0; node < face.node_count; ++node)
      least = std::min(least, (nodes.col(node) - x).norm());
    const auto& projection = pairs[i].projection;
    EXPECT_NEAR((face_position(face.type, nodes, projection.clamped) - x).norm(), least, 1e-9);
    EXPECT_EQ(projection.clamp_derivative, Eigen::Matrix2d::Zero().eval());
    EXPECT_FALSE(projection.inside());
  }
  EXPECT_GT(paired, 10);
}

TEST_P(PairsOn, AreTheSameWhateverFaceIsGuessed) {
  const auto model = model_of_plates();
  const auto& zone = model.zones.front();
  const auto u = moved(model, 0.05);
  const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
  const auto master = master_of(zone, configuration);
  const PointTree tree(master);
  for (const auto& point : zone.points) {
    const auto x = position(point, configuration);
    const auto node = tree.nearest(x).index;
    const auto plain = pair_around(zone, node, x, master);
    for (const int guess : zone.master.faces_of_node[node]) {
      const auto guessed = pair_around(zone, node, x, master, guess);
      EXPECT_EQ(guessed.master_face, plain.master_face);
      EXPECT_EQ(guessed.projection.clamped, plain.projection.clamped);
    }
  }
}

TEST_P(PairsOn, AreTheSameAmongTheFacesAroundANode) {
  const auto model = model_of_plates();
  const auto& zone = model.zones.front();
  const auto u = moved(model, 0.05);
  const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
  const auto master = master_of(zone, configuration);
  const PointTree tree(master);
  int paired = 0, unpaired = 0;
  for (const auto& point : zone.points) {
    const auto x = position(point, configuration);
    const auto node = tree.nearest(x).index;
    const auto around = pair_around(zone, node, x, master);
    const auto among = pair_among(zone, zone.master.faces_of_node[node], x, master);
    EXPECT_EQ(among.master_face, around.master_face);
    EXPECT_EQ(among.projection.clamped, around.projection.clamped);
    EXPECT_FALSE(pair_among(zone, {}, x, master).paired());
    ++(around.paired() ? paired : unpaired);
  }
  EXPECT_GT(paired, 0);
  EXPECT_GT(unpaired, 0);
}

INSTANTIATE_TEST_SUITE_P(Faces, PairsOn, testing::Values("hexa8", "hexa20", "hexa27", "tetra4", "tetra10"),
                         [](const auto& cells) { return std::string(cells.param); });

} // namespace
} // namespace rubato::contact::pairing_test
