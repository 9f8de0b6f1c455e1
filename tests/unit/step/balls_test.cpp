// SPDX-License-Identifier: LGPL-3.0-or-later
/// Two elastic balls pressed on each other, up to the axis of revolution (H. Hertz, J. reine angew. Math. 92,
/// 1881).
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/results/nodal_fields.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::step::balls_test {
namespace {

using test::Walk;

constexpr double radius = 50;
constexpr double core = 5; ///< of the inner sphere, which is moved with the plane of the equator
constexpr double young = 20000;
constexpr double poisson = 0.3;
constexpr double closed_by = 0.05; ///< each ball

/// Rectangles over [0, 1]², the lower ball's shifted to x in [2, 3].
std::string deck(const std::string& cells) {
  const std::string grid = "divisions: [22, 14], cells: " + cells;
  return R"(
mesh:
  generate:
    - {name: upper, rectangle: {from: [0, 0], to: [1, 1]}, )" +
         grid + R"(, sides: {left: axis, top: pushed, right: pushed, bottom: above}}
    - {name: lower, rectangle: {from: [2, 0], to: [3, 1]}, )" +
         grid + R"(, sides: {left: axis, top: held, right: held, bottom: below}}
physics: axisymmetric
materials: {rubber: {young: 20000, poisson: 0.3}}
supports: [{on: axis, fix: x}, {on: pushed, y: -0.05}, {on: held, y: 0.05}]
contact: {pole: {master: below, slave: above, integration: nodes}}
time: {scheme: static, step: 1, end: 1}
)";
}

/// From 0 to 1, finer near 0.
double graded(double s) {
  constexpr double steepness = 5.5;
  return std::sinh(steepness * s) / std::sinh(steepness);
}

/// x is the angle from the pole, y the way from the skin to the core.
mesh::Mesh as_balls(mesh::Mesh mesh) {
  for (auto& point : mesh.points) {
    const bool lower = point.x() > 1.5;
    const double angle = std::numbers::pi / 2 * graded(lower ? point.x() - 2 : point.x());
    const double r = radius - (radius - core) * graded(point.y());
    const double up = radius - r * std::cos(angle);
    point = Eigen::Vector3d(r * std::sin(angle), lower ? -up : up, 0);
  }
  return mesh;
}

/// The line p² = p₀² (1 − r²/a²) through the pressures well inside.
struct Hertz {
  double pole = 0;
  double radius = 0;
};

Hertz fitted(const Walk& walk) {
  std::vector<Eigen::Vector2d> pressed;
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    if (const double p = walk.pressure(i), r = walk.slave_point(i).x(); p > 0 && r > 0.1 && r < 1.2)
      pressed.push_back({r * r, p * p});
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (const auto& at : pressed) {
    const Eigen::Vector2d row(1, at[0]);
    normal += row * row.transpose();
    right += row * at[1];
  }
  const Eigen::Vector2d line = normal.inverse() * right;
  return {std::sqrt(line[0]), std::sqrt(-line[0] / line[1])};
}

double field_at(const Walk& walk, const std::string& name, mesh::NodeIndex node) {
  for (const auto& field : results::nodal_fields(walk.model, walk.state()))
    if (field.name == name)
      return field.values[static_cast<std::size_t>(node)];
  return NAN;
}

/// The slave's: both balls have a node at the pole.
mesh::NodeIndex pole_of(const Walk& walk) {
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    if (walk.slave_point(i).norm() < 1e-9)
      return walk.model.zones.front().slave.nodes[i];
  return -1;
}

class Balls : public testing::TestWithParam<const char*> {};

TEST_P(Balls, TouchAsHertzSays) {
  const auto study = deck::parse_deck(deck(GetParam()), "deck.yaml", {}).runs.front();
  auto mesh = as_balls(model::load_mesh(study.mesh));
  mesh::mend_orientation(mesh);
  Walk walk(study, std::move(mesh));
  ASSERT_TRUE(walk.to_end());
  const double stiffness = young / (1 - poisson * poisson) / 2;
  const double curvature = radius / 2;
  const double closing = 2 * closed_by;
  const double force = 4.0 / 3 * stiffness * std::sqrt(curvature) * std::pow(closing, 1.5);
  const double width = std::sqrt(curvature * closing);
  const double pole = 3 * force / (2 * std::numbers::pi * width * width);
  const auto found = walk.resultants();
  EXPECT_NEAR(found.force.y(), force, 0.03 * force);
  const auto fit = fitted(walk);
  EXPECT_NEAR(fit.radius, width, 0.03 * width);
  EXPECT_NEAR(fit.pole, pole, 0.1 * pole);
  const auto at_pole = pole_of(walk);
  ASSERT_GE(at_pole, 0);
  EXPECT_NEAR(field_at(walk, "contact_pressure", at_pole), pole, 0.1 * pole);
  EXPECT_GE(field_at(walk, "contact_gap", at_pole), -1e-9 * walk.model.zones.front().edge());
}

INSTANTIATE_TEST_SUITE_P(Of, Balls, testing::Values("quad8", "tria6", "quad4", "quad9"));

} // namespace
} // namespace rubato::step::balls_test
