// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of small strain that turn or stretch too far are told, once each; others are not.
#include "rubato/model/model.hpp"
#include "rubato/run/strain_watch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::run::strain_watch_test {
namespace {

/// How a body is moved as a whole: u = turn about z or a stretch along x, by the displacement of all nodes.
struct Moved {
  std::string physics, cells;
  double turn = 0;
  double stretch = 0;
};

bool is_solid(const Moved& moved) {
  return moved.physics == "solid";
}

std::string deck_of(const Moved& moved, const std::string& material) {
  const std::string body = is_solid(moved)
                               ? fmt::format("box: {{from: [1, 0, 0], to: [2, 1, 1]}}, divisions: [2, 2, 2], "
                                             "cells: {}, sides: {{left: left}}",
                                             moved.cells)
                               : fmt::format("rectangle: {{from: [1, 0], to: [2, 1]}}, divisions: [2, 2], "
                                             "cells: {}, sides: {{left: left}}",
                                             moved.cells);
  return fmt::format(R"(
mesh: {{generate: [{{name: body, {}}}]}}
physics: {}
materials: {{steel: {{young: 1000, poisson: 0.3, {}}}}}
supports: [{{on: left, fix: [{}]}}]
time: {{scheme: static, end: 1, step: 1}}
)",
                     body, moved.physics, material, is_solid(moved) ? "x, y, z" : "x, y");
}

Eigen::VectorXd displacements(const model::Model& model, const Moved& moved) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.dofs.dof_count);
  for (mesh::NodeIndex node = 0; node < model.mesh.node_count(); ++node) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    const double c = std::cos(moved.turn), s = std::sin(moved.turn);
    const Eigen::Vector2d stretched((1 + moved.stretch) * x[0], x[1]);
    u[model.dofs.dof(node, 0)] = c * stretched[0] - s * stretched[1] - x[0];
    u[model.dofs.dof(node, 1)] = s * stretched[0] + c * stretched[1] - x[1];
  }
  return u;
}

std::vector<std::string> warnings_of(const Moved& moved, const std::string& material = "strain: small") {
  test::Walk walk(deck_of(moved, material));
  std::vector<std::string> warned;
  Watch watch;
  watch.warn = [&](const std::string& text) { warned.push_back(text); };
  StrainWatch strains(walk.model, watch);
  const auto u = displacements(walk.model, moved);
  strains.note(0, Eigen::VectorXd::Zero(u.size()));
  strains.note(0.5, u);
  strains.note(1, u);
  return warned;
}

const std::vector<std::pair<std::string, std::string>> bodies{
    {"plane_strain", "quad4"}, {"plane_strain", "quad8"}, {"plane_strain", "quad9"},
    {"plane_stress", "tria3"}, {"plane_stress", "tria6"}, {"axisymmetric", "quad4"},
    {"solid", "hexa8"},        {"solid", "hexa20"},       {"solid", "hexa27"},
    {"solid", "tetra4"},       {"solid", "tetra10"},      {"solid", "penta6"},
    {"solid", "penta15"}};

TEST(Strains, TurnsBeyondSmallOnesAreToldOnce) {
  for (const auto& [physics, cells] : bodies) {
    if (physics == "axisymmetric")
      continue; // does not turn
    for (const double angle : {0.04, -0.045, 0.049})
      EXPECT_TRUE(warnings_of({physics, cells, angle}).empty()) << cells << " by " << angle;
    for (const double angle : {0.051, -0.1, 0.3}) {
      const auto warned = warnings_of({physics, cells, angle});
      ASSERT_EQ(warned.size(), 1U) << cells << " by " << angle;
      EXPECT_NE(warned[0].find("of material 'steel' has turned by"), std::string::npos) << warned[0];
    }
  }
}

TEST(Strains, StretchesBeyondSmallOnesAreToldOnce) {
  for (const auto& [physics, cells] : bodies) {
    for (const double stretch : {0.04, -0.045, 0.049})
      EXPECT_TRUE(warnings_of({physics, cells, 0, stretch}).empty()) << cells << " by " << stretch;
    for (const double stretch : {0.051, -0.1, 0.3}) {
      const auto warned = warnings_of({physics, cells, 0, stretch});
      ASSERT_EQ(warned.size(), 1U) << cells << " by " << stretch;
      EXPECT_NE(warned[0].find(fmt::format("has a strain of {:.3g}, more than 0.05", std::abs(stretch))),
                std::string::npos)
          << warned[0];
    }
  }
}

TEST(Strains, AreToldWithTheCellAndWhatToWrite) {
  const auto warned = warnings_of({"plane_strain", "quad4", 0.1});
  EXPECT_EQ(warned.at(0).substr(0, 21), "run: at t = 0.5 cell ");
  EXPECT_NE(warned.at(0).find("(QUAD4) at (1."), std::string::npos) << warned.at(0);
  EXPECT_NE(
      warned.at(0).find(" of material 'steel' has turned by 0.0998 radians, more than 0.05: small strain "
                        "stretches what turns, here by 0.005; expected 'strain: green_lagrange'"),
      std::string::npos)
      << warned.at(0);
}

TEST(Strains, ThatTurnWithTheBodyAreNotTold) {
  for (const std::string strain : {"green_lagrange", "logarithmic"})
    for (const std::string cells : {"quad4", "tria6"})
      EXPECT_TRUE(warnings_of({"plane_strain", cells, 0.5, 0.2}, "strain: " + strain).empty()) << strain;
}

} // namespace
} // namespace rubato::run::strain_watch_test
