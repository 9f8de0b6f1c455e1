// SPDX-License-Identifier: LGPL-3.0-or-later
// A flexible arm with a hook at its end snaps over a round cam: a point that only contact holds aside,
// normals that turn by 54° within a face, and a way that ends in a fall.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace rubato::step::snap_hook_test {
namespace {

/// The cam is x: angle, y: radius; the arm ends at x = 31.
std::string deck_of(const std::string& cells, const std::string& integration, double friction) {
  return R"(
mesh:
  generate:
    - {name: arm, rectangle: {from: [0, 0], to: [31, 2]}, divisions: [62, 2], cells: )" +
         cells + R"(, sides: {left: root, bottom: hook, right: hook}}
    - {name: cam, rectangle: {from: [40, 0.3], to: [43.14159265358979, 1]}, divisions: [9, 2], cells: )" +
         cells + R"(, sides: {top: round, bottom: ground}}
physics: plane_stress
thickness: 5
materials: {pom: {young: 3000, poisson: 0.35}}
supports: [{on: ground, fix: [x, y]}, {on: root, x: {value: 8, function: ramp}, y: 0}]
functions: {ramp: {times: [0, 1], values: [0, 1]}}
contact: {c: {master: round, slave: hook, integration: )" +
         integration + ", friction: " + std::to_string(friction) + R"(}}
time: {scheme: static, step: 0.02, end: 1}
)";
}

/// How far the hook reaches below the arm.
double depth_at(double x) {
  if (x < 26)
    return 0;
  if (x < 27.5)
    return (x - 26) / 1.5 * 2;
  return x < 28 ? 2 : 2 * (31 - x) / 3;
}

mesh::Mesh bent(mesh::Mesh mesh) {
  for (auto& point : mesh.points) {
    const double x = point.x(), y = point.y();
    if (x > 35)
      point = {32.7 + y * std::cos(43.14159265358979 - x), -1.5 + y * std::sin(43.14159265358979 - x), 0};
    else
      point.y() = y - depth_at(x) * (1 - y / 2);
  }
  return mesh;
}

struct Snap {
  double highest_pull = 0; ///< of the root, across [force]
  int iterations = 0, failed = 0;
  bool ended = false;
};

Snap snap(const std::string& deck) {
  const auto study = deck::parse_deck(deck, "deck.yaml", {}).runs.front();
  test::Walk walk(study, bent(model::load_mesh(study.mesh)));
  Snap snap;
  walk.accepted = [&] {
    double pull = 0;
    for (const auto node : mesh::nodes_named(walk.model.mesh, "root"))
      pull += walk.state().reaction[walk.model.dofs.dof(node, 1)];
    snap.highest_pull = std::max(snap.highest_pull, std::abs(pull));
  };
  snap.ended = walk.to_end();
  for (const auto& report : walk.reports) {
    snap.iterations += report.iterations;
    snap.failed += report.failed() ? 1 : 0;
  }
  return snap;
}

class SnapHook : public testing::TestWithParam<std::tuple<const char*, double>> {};

TEST_P(SnapHook, PassesTheCamWithoutACutAndPullsAsOnNodes) {
  const auto [cells, friction] = GetParam();
  const auto by_mortar = snap(deck_of(cells, "mortar", friction));
  EXPECT_TRUE(by_mortar.ended);
  EXPECT_EQ(by_mortar.failed, 0);
  EXPECT_LT(by_mortar.iterations, 15 * 50);
  const auto on_nodes = snap(deck_of(cells, "nodes", friction));
  EXPECT_NEAR(by_mortar.highest_pull, on_nodes.highest_pull, 0.05 * on_nodes.highest_pull);
}

INSTANTIATE_TEST_SUITE_P(Of, SnapHook,
                         testing::Combine(testing::Values("tria3", "quad4", "tria6", "quad8"),
                                          testing::Values(0., 0.2)));

} // namespace
} // namespace rubato::step::snap_hook_test
