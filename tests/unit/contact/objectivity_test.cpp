// SPDX-License-Identifier: LGPL-3.0-or-later
/// A body with edges on another one, turned as a whole: contact turns with them.
#include "rubato/contact/discretisation.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::contact::objectivity_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

struct Scene {
  const char* cells;
  const char* integration;
  bool block_is_slave;
};

std::string deck_of(const Scene& scene) {
  const std::string_view cells = scene.cells;
  const bool solid = !cells.starts_with("quad") && !cells.starts_with("tria");
  const auto body = [&](const char* name, const char* from, const char* to, const char* divisions,
                        const char* sides) {
    return solid ? fmt::format("    - {{name: {}, box: {{from: [{}, 0], to: [{}, 1]}}, divisions: [{}, 2], "
                               "cells: {}, sides: {{{}}}}}\n",
                               name, from, to, divisions, scene.cells, sides)
                 : fmt::format("    - {{name: {}, rectangle: {{from: [{}], to: [{}]}}, divisions: [{}], "
                               "cells: {}, sides: {{{}}}}}\n",
                               name, from, to, divisions, scene.cells, sides);
  };
  const char* held = solid ? "x, y, z" : "x, y";
  return fmt::format(
      "mesh:\n  generate:\n{}{}physics: {}\nmaterials: {{steel: {{young: 1000, poisson: 0.3}}}}\n"
      "supports: [{{on: ground, fix: [{}]}}, {{on: held, fix: [{}]}}]\n"
      "contact: {{joint: {{slave: {}, master: {}, friction: 0.2, integration: {}}}}}\n"
      "time: {{scheme: static, step: 1, end: 1}}\n",
      body("rail", "0, 0", "4, 1", "5, 1", "bottom: ground, top: above"),
      body("block", "1, 1", "2.5, 2", "2, 1", "bottom: below, top: held"), solid ? "solid" : "plane_strain",
      held, held, scene.block_is_slave ? "below" : "above", scene.block_is_slave ? "above" : "below",
      scene.integration);
}

/// The block tilted about one of its edges, which it presses into the rail; both with a random strain.
VectorXd pressed(const test::BuiltModel& model, double tilt, double slide) {
  VectorXd u(model.dofs.dof_count);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> small(-0.003, 0.003);
  const Vector3d about(2.5, 1, 0);
  const Matrix3d turn = Eigen::AngleAxisd(tilt, Vector3d::UnitZ()).toRotationMatrix();
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    const auto block = mesh::nodes_named(model.mesh, "block");
    Vector3d moved = Vector3d::Zero();
    if (std::ranges::find(block, node) != block.end())
      moved = about + turn * (x - about) - x + Vector3d(slide, -0.02, 0);
    for (int i = 0; i < model.dofs.components; ++i)
      u[model.dofs.dof(node, i)] = moved[i] + small(random);
  }
  return u;
}

VectorXd turned(const test::BuiltModel& model, const VectorXd& u, const Matrix3d& rotation) {
  VectorXd whole(u.size());
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    Vector3d moved = Vector3d::Zero();
    for (int i = 0; i < model.dofs.components; ++i)
      moved[i] = u[model.dofs.dof(node, i)];
    const Vector3d there = rotation * (x + moved) - x;
    for (int i = 0; i < model.dofs.components; ++i)
      whole[model.dofs.dof(node, i)] = there[i];
  }
  return whole;
}

std::vector<PointEvaluation> measured(const test::BuiltModel& model, const VectorXd& start,
                                      const VectorXd& u) {
  const auto& zone = model.zones.front();
  auto discretisation = make_discretisation(zone);
  std::vector<PointEvaluation> points;
  measure(discretisation, VectorXd::Zero(zone.multiplier_count()), {&model.mesh, &model.dofs, &u, &start},
          points);
  return points;
}

/// Of a stencil, by node of the mesh.
VectorXd weights_of(const Stencil& stencil, int nodes) {
  VectorXd weights = VectorXd::Zero(nodes);
  for (std::size_t i = 0; i < stencil.nodes.size(); ++i)
    weights[stencil.nodes[i]] += stencil.weights[static_cast<Eigen::Index>(i)];
  return weights;
}

Vector3d slip_of(const Kinematics& k) {
  return k.tangents.col(0) * k.slip[0] + k.tangents.col(1) * (k.parametric_dimension > 1 ? k.slip[1] : 0);
}

/// How many points face the other side. Their gaps stay, their normals and slips turn; forces on both sides
/// are in balance.
int expect_turned(const std::vector<PointEvaluation>& before, const std::vector<PointEvaluation>& after,
                  const Matrix3d& rotation, int nodes) {
  int facing = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].kinematics.has_value(), after[i].kinematics.has_value()) << i;
    if (!before[i].kinematics || !after[i].kinematics)
      continue;
    ++facing;
    const auto& a = *before[i].kinematics;
    const auto& b = *after[i].kinematics;
    EXPECT_NEAR(a.gap, b.gap, 1e-12) << i;
    EXPECT_LE((rotation * a.normal - b.normal).norm(), 1e-11) << i;
    EXPECT_LE((rotation * slip_of(a) - slip_of(b)).norm(), 1e-11) << i;
    EXPECT_LE((weights_of(a.stencil, nodes) - weights_of(b.stencil, nodes)).norm(), 1e-11) << i;
    EXPECT_NEAR(b.stencil.weights.sum(), 0, 1e-13) << i;
  }
  return facing;
}

class Turned : public testing::TestWithParam<const char*> {};

TEST_P(Turned, ContactOfEdgesTurnsWithTheBodies) {
  for (const auto* integration : {"mortar", "nodes"})
    for (const bool block_is_slave : {true, false}) {
      const auto model = test::model_of(deck_of({GetParam(), integration, block_is_slave}).c_str(), {});
      const Vector3d axis = model.mesh.dimension == 3 ? Vector3d(1, 2, 3).normalized() : Vector3d::UnitZ();
      for (const double tilt : {-0.3, -0.03, 0.0, 0.03})
        for (const double angle : {0.4, 1.9, -2.8}) {
          SCOPED_TRACE(fmt::format("{}, slave {}, tilt {}, turned by {}", integration,
                                   block_is_slave ? "block" : "rail", tilt, angle));
          const Matrix3d rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
          const auto start = pressed(model, tilt, 0), u = pressed(model, tilt, 0.07);
          const auto before = measured(model, start, u);
          const auto after = measured(model, turned(model, start, rotation), turned(model, u, rotation));
          EXPECT_GT(expect_turned(before, after, rotation, static_cast<int>(model.mesh.points.size())), 0);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Cells, Turned,
                         testing::Values("quad4", "quad8", "quad9", "tria3", "tria6", "tria7", "hexa8",
                                         "hexa20", "hexa27", "tetra4", "tetra10", "penta6", "penta15"),
                         [](const auto& chosen) { return std::string(chosen.param); });

} // namespace
} // namespace rubato::contact::objectivity_test
