// SPDX-License-Identifier: LGPL-3.0-or-later
// Normals that are averaged at nodes: their values, their derivatives, and where they end.
#include "rubato/contact/averaged_normal.hpp"
#include "rubato/contact/kinematics.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <tuple>

namespace rubato::contact::averaged_normal_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

std::string deck_of(const std::string& cells, const std::string& zone) {
  const bool solid = !cells.starts_with("quad") && !cells.starts_with("tria");
  const auto body = [&](const char* name, const char* from, const char* to, const char* divisions,
                        const char* sides) {
    return solid ? fmt::format("    - {{name: {}, box: {{from: [{}, 0], to: [{}, 2]}}, divisions: [{}, 3], "
                               "cells: {}, sides: {{{}}}}}\n",
                               name, from, to, divisions, cells, sides)
                 : fmt::format("    - {{name: {}, rectangle: {{from: [{}], to: [{}]}}, divisions: [{}], "
                               "cells: {}, sides: {{{}}}}}\n",
                               name, from, to, divisions, cells, sides);
  };
  const char* held = solid ? "x, y, z" : "x, y";
  return fmt::format(
      "mesh:\n  generate:\n{}{}physics: {}\nmaterials: {{steel: {{young: 1000, poisson: 0.3}}}}\n"
      "supports: [{{on: ground, fix: [{}]}}, {{on: held, fix: [{}]}}]\n"
      "contact: {{joint: {{slave: below, master: above, friction: 0.2, {}}}}}\n"
      "time: {{scheme: static, step: 1, end: 1}}\n",
      body("rail", "0, 0", "4, 1", "4, 1", "bottom: ground, top: above"),
      body("block", "1.1, 1.05", "2.9, 2", "3, 1", "bottom: below, top: held"),
      solid ? "solid" : "plane_strain", held, held, zone);
}

VectorXd scattered(const test::BuiltModel& model, double amount) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> small(-amount, amount);
  return VectorXd::NullaryExpr(model.dofs.dof_count, [&] { return small(random); });
}

struct Point {
  const Zone* zone;
  std::size_t index;
  Kinematics at(const test::BuiltModel& model, const VectorXd& u, const VectorXd& start) const {
    const Configuration configuration{&model.mesh, &model.dofs, &u, &start};
    return evaluate_kinematics(*zone, zone->points[index], find_pairs(*zone, configuration)[index],
                               configuration);
  }
};

class SmoothedNormals : public testing::TestWithParam<std::tuple<const char*, const char*, const char*>> {};

TEST_P(SmoothedNormals, VaryAsTheySay) {
  constexpr double h = 1e-6;
  const auto [cells, normal, rule] = GetParam();
  const auto model = test::model_of(
      deck_of(cells, fmt::format("smoothing: true, normal: {}, integration: {}", normal, rule)));
  const auto& zone = model.zones.front();
  const auto u = scattered(model, 0.04);
  const VectorXd start = 0.5 * u;
  const auto pairs = find_pairs(zone, {&model.mesh, &model.dofs, &u, &start});
  int compared = 0;
  for (std::size_t p = 0; p < pairs.size(); p += 2) {
    if (!pairs[p].paired() || !pairs[p].projection.inside())
      continue;
    const Point point{&zone, p};
    const auto at = point.at(model, u, start);
    for (std::size_t node = 0; node < at.stencil.nodes.size(); ++node)
      for (int c = 0; c < at.stencil.components; ++c) {
        const auto dof = model.dofs.dof(at.stencil.nodes[node], c);
        VectorXd forward = u, backward = u;
        forward[dof] += h;
        backward[dof] -= h;
        const auto plus = point.at(model, forward, start), minus = point.at(model, backward, start);
        const auto column = static_cast<Eigen::Index>(node) * at.stencil.components + c;
        EXPECT_NEAR((plus.gap - minus.gap) / (2 * h), at.d_gap[column], 2e-7);
        EXPECT_LT(((plus.normal - minus.normal) / (2 * h) - at.d_normal.col(column)).norm(), 2e-7);
        EXPECT_LT(((plus.slip - minus.slip) / (2 * h) - at.d_slip.col(column)).norm(), 2e-7);
        for (int a = 0; a < at.parametric_dimension; ++a)
          EXPECT_LT(((plus.tangents.col(a) - minus.tangents.col(a)) / (2 * h) -
                     at.d_tangent[static_cast<std::size_t>(a)].col(column))
                        .norm(),
                    2e-7);
        ++compared;
      }
  }
  EXPECT_GE(compared, 20);
}

/// The stencil has every node that turns the normal: no other one changes anything.
TEST_P(SmoothedNormals, DependOnTheirStencilAlone) {
  const auto [cells, normal, rule] = GetParam();
  const auto model = test::model_of(
      deck_of(cells, fmt::format("smoothing: true, normal: {}, integration: {}", normal, rule)));
  const auto& zone = model.zones.front();
  const auto u = scattered(model, 0.04);
  const auto pairs = find_pairs(zone, {&model.mesh, &model.dofs, &u, &u});
  for (std::size_t p = 0; p < pairs.size(); p += 3) {
    if (!pairs[p].paired())
      continue;
    const Point point{&zone, p};
    const auto before = point.at(model, u, u);
    VectorXd other = scattered(model, 0.041);
    for (const auto node : before.stencil.nodes)
      for (int c = 0; c < before.stencil.components; ++c)
        other[model.dofs.dof(node, c)] = u[model.dofs.dof(node, c)];
    const Configuration configuration{&model.mesh, &model.dofs, &other, &other};
    const auto after = evaluate_kinematics(zone, zone.points[p], pairs[p], configuration);
    EXPECT_LT((after.normal - before.normal).norm(), 1e-15);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cells, SmoothedNormals,
    testing::Combine(testing::Values("quad4", "quad8", "tria6", "hexa8", "hexa20", "penta15"),
                     testing::Values("master", "slave", "average"), testing::Values("nodes", "{gauss: 3}")));

/// Faces of a surface whose nodes lie on a cylinder: averages are along its radii at the nodes, and keep
/// close to them between the nodes.
TEST(AveragedNormals, AreThoseOfACylinderAtItsNodes) {
  const auto model = test::model_of(deck_of("hexa8", "smoothing: true, integration: nodes"));
  const auto& zone = model.zones.front();
  VectorXd u = VectorXd::Zero(model.dofs.dof_count);
  constexpr double radius = 5;
  for (const auto node : zone.master.nodes) { // y = 1 becomes a part of a cylinder about z
    const double angle = (model.mesh.points[static_cast<std::size_t>(node)].x() - 2) / radius;
    u[model.dofs.dof(node, 0)] =
        2 + radius * std::sin(angle) - model.mesh.points[static_cast<std::size_t>(node)].x();
    u[model.dofs.dof(node, 1)] = radius * (std::cos(angle) - 1);
  }
  const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
  const Vector3d axis(2, 1 - radius, 0);
  int inner = 0;
  for (std::size_t f = 0; f < zone.master.faces.size(); ++f) {
    const auto& face = zone.master.faces[f];
    const auto nodes = deformed(face, configuration);
    for (const Eigen::Vector2d& xi :
         {Eigen::Vector2d(-1, -1), Eigen::Vector2d(1, 1), Eigen::Vector2d(0.3, -0.2)}) {
      Vector3d place = face_position(face.type, nodes, xi);
      const auto average =
          averaged_normal(zone.master, static_cast<int>(f), face_values(face.type, xi), configuration)
              .normalized();
      place -= axis;
      place.z() = 0;
      const double from_end = std::min(place.x() + 2, 2 - place.x());
      if (from_end < 1) // at the ends there is one face only
        continue;
      ++inner;
      const bool at_node = std::abs(xi[0]) == 1;
      EXPECT_LT((average - place.normalized()).norm(), at_node ? 1e-14 : 1e-3);
      EXPECT_GT((outward_normal(face.type, nodes, xi) - place.normalized()).norm(), 0.02);
    }
  }
  EXPECT_GT(inner, 10);
}

/// Two sides of a corner keep their own normals.
TEST(AveragedNormals, EndAtSharpEdges) {
  const auto model = test::model_of(R"(
mesh:
  generate:
    - {name: rail, rectangle: {from: [0, 0], to: [4, 1]}, divisions: [4, 2], cells: quad4, sides: {bottom: ground, top: above, right: beside}}
    - {name: block, rectangle: {from: [1, 1], to: [2, 2]}, divisions: [1, 1], cells: quad4, sides: {bottom: below, top: held}}
  groups: {around: {union: [above, beside]}}
physics: plane_strain
materials: {steel: {young: 1000, poisson: 0.3}}
supports: [{on: ground, fix: [x, y]}, {on: held, fix: [x, y]}]
contact: {joint: {slave: below, master: around, smoothing: true, integration: nodes}}
time: {scheme: static, step: 1, end: 1}
)");
  const auto& surface = model.zones.front().master;
  const VectorXd u = VectorXd::Zero(model.dofs.dof_count);
  const Configuration configuration{&model.mesh, &model.dofs, &u, &u};
  ASSERT_EQ(surface.faces.size(), 6U);
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto& face = surface.faces[f];
    const auto own = outward_normal(face.type, deformed(face, configuration), Eigen::Vector2d::Zero());
    for (const double xi : {-1.0, 0.2, 1.0})
      EXPECT_LT(
          (averaged_normal(surface, static_cast<int>(f), face_values(face.type, {xi, 0}), configuration) -
           own)
              .norm(),
          1e-15);
  }
}

} // namespace
} // namespace rubato::contact::averaged_normal_test
