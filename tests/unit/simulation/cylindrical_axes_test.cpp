// SPDX-License-Identifier: LGPL-3.0-or-later
// Tubes whose axes of orthotropy turn with the place.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace rubato::simulation::cylindrical_axes_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double inner = 1;
constexpr double outer = 2;
constexpr double quarter = std::numbers::pi / 2;

/// Takes (radius, angle, z) to a quarter of a tube.
mesh::Mesh bent(mesh::Mesh mesh) {
  for (auto& x : mesh.points)
    x = Vector3d(x[0] * std::cos(x[1]), x[0] * std::sin(x[1]), x[2]);
  return mesh;
}

mesh::Mesh turned(mesh::Mesh mesh, const Matrix3d& turn) {
  for (auto& x : mesh.points)
    x = turn * x;
  return mesh;
}

study::Study study_of(const std::string& deck) {
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

struct Solved {
  mesh::Mesh mesh;
  domain::DofMap dofs;
  Eigen::VectorXd u;

  Vector3d at(mesh::NodeIndex node) const {
    Vector3d displacement = Vector3d::Zero();
    for (int i = 0; i < dofs.components; ++i)
      displacement[i] = u[dofs.dof(node, i)];
    return displacement;
  }
};

Solved solved(const study::Study& study, const mesh::Mesh& mesh) {
  const test::BuiltModel built(study, mesh);
  Simulation simulation(built);
  while (!simulation.finished())
    simulation.advance();
  return {mesh, test::ModelParts(simulation.model()).dofs, simulation.state().motion.u};
}

/// x' radial, y' around, z' along.
const std::string timber = "law: orthotropic, young_x: 10, young_y: 150, young_z: 30, poisson_xy: 0.03, "
                           "poisson_yz: 0.4, poisson_xz: "
                           "0.2, shear_xy: 7, shear_yz: 20, shear_xz: 5";

std::string plane_tube(int divisions) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: tube, rectangle: {{from: [{}, 0], to: [{}, {}]}}, divisions: [{}, {}], cells: quad8,
       sides: {{left: bore, bottom: floor, top: wall}}}}
physics: plane_strain
materials: {{wood: {{{}, axes: {{cylindrical: {{point: [0, 0]}}}}}}}}
supports: [{{on: floor, fix: y}}, {{on: wall, fix: x}}]
loads: [{{pressure: {{on: bore, value: 2}}}}]
time: {{scheme: static, step: 1, end: 1}}
)",
                     inner, outer, quarter, divisions, divisions, timber);
}

/// S. G. Lekhnitskii, Anisotropic Plates, 1968: of an orthotropic tube under inner pressure p, in plane
/// strain, with β_ij = S_ij − S_iz S_jz/S_zz, k² = β_rr/β_θθ and c = a/b,
///   σ_r = p c^(k+1)/(1 − c^2k) ((r/b)^(k−1) − (b/r)^(k+1)),  σ_θ = d(r σ_r)/dr,  u = r (β_rθ σ_r + β_θθ
///   σ_θ).
double radial_displacement(double r) {
  constexpr double er = 10, et = 150, ez = 30, nrt = 0.03, ntz = 0.4, nrz = 0.2, p = 2;
  const double szz = 1 / ez, srz = -nrz / er, stz = -ntz / et;
  const double brr = 1 / er - srz * srz / szz, btt = 1 / et - stz * stz / szz;
  const double brt = -nrt / er - srz * stz / szz;
  const double k = std::sqrt(brr / btt), c = inner / outer;
  const double scale = p * std::pow(c, k + 1) / (1 - std::pow(c, 2 * k));
  const double rising = scale * std::pow(r / outer, k - 1), falling = scale * std::pow(outer / r, k + 1);
  return r * (brt * (rising - falling) + btt * k * (rising + falling));
}

/// The largest at any node, of the largest displacement.
double error_of_tube(int divisions) {
  const auto study = study_of(plane_tube(divisions));
  const auto found = solved(study, bent(model::load_mesh(study.mesh)));
  double error = 0;
  for (const auto node : found.dofs.nodes) {
    const Vector3d x = found.mesh.points[static_cast<std::size_t>(node)];
    error = std::max(error, (found.at(node) - radial_displacement(x.norm()) * x.normalized()).norm());
  }
  return error / radial_displacement(inner);
}

TEST(AnOrthotropicTube, WidensAsLekhnitskiiSaysAndConverges) {
  const double coarse = error_of_tube(4), middle = error_of_tube(8), fine = error_of_tube(16);
  EXPECT_LT(middle, 5e-3);
  EXPECT_LT(fine, 5e-4);
  EXPECT_LT(fine, middle / 4);
  EXPECT_LT(middle, coarse / 4);
  RecordProperty("errors", fmt::format("{:.3g} {:.3g} {:.3g}", coarse, middle, fine));
}

std::string solid_tube(const std::string& axes) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: tube, box: {{from: [{}, 0, 0], to: [{}, {}, 1.5]}}, divisions: [2, 3, 2], cells: hexa20,
       sides: {{left: bore, back: lid, front: floor, top: wall}}}}
physics: solid
materials: {{wood: {{{}, angle_x: 30, angle_z: 10, axes: {{cylindrical: {{{}}}}}}}}}
supports: [{{on: floor, fix: [x, y, z]}}]
loads: [{{pressure: {{on: bore, value: 2}}}}, {{pressure: {{on: wall, value: 1}}}}]
time: {{scheme: static, step: 1, end: 1}}
)",
                     inner, outer, quarter, timber, axes);
}

TEST(AnOrthotropicTube, TurnedAsAWholeGivesTheTurnedAnswer) {
  const auto upright = study_of(solid_tube("point: [0, 0, 7], direction: [0, 0, 1]"));
  const auto mesh = bent(model::load_mesh(upright.mesh));
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  auto leaning = upright;
  auto& axes = *leaning.materials[0].orthotropy.cylindrical;
  const Vector3d point = turn * Vector3d(0, 0, -3), direction = 2.5 * turn.col(2);
  axes = {{point[0], point[1], point[2]}, {direction[0], direction[1], direction[2]}};
  const auto expected = solved(upright, mesh);
  const auto found = solved(leaning, turned(mesh, turn));
  double error = 0, largest = 0, around = 0;
  for (const auto node : expected.dofs.nodes) {
    const Vector3d x = expected.mesh.points[static_cast<std::size_t>(node)];
    error = std::max(error, (found.at(node) - turn * expected.at(node)).norm());
    largest = std::max(largest, expected.at(node).norm());
    around = std::max(around, std::abs(expected.at(node).dot(Vector3d(-x[1], x[0], 0).normalized())));
  }
  EXPECT_LT(error, 1e-12 * largest);
  EXPECT_GT(around, 0.05 * largest) << "a helix twists";
  RecordProperty("error", fmt::format("{:.3g}", error / largest));
}

std::string told(const std::string& deck) {
  return test::fault_of([&] {
    const auto study = study_of(deck);
    test::BuiltModel{study};
  });
}

std::string with_point(const std::string& point) {
  auto deck = plane_tube(1);
  return deck.replace(deck.find("point: [0, 0]"), 13, "point: " + point);
}

/// In the middle of the cell, where a quadrature point is, and near a corner, where none is.
TEST(CylindricalAxes, AreRefusedInACellThatTheirLineCrosses) {
  for (const auto* point : {"[1.5, 0.7853981633974483]", "[1.01, 0.02]"}) {
    const auto fault = told(with_point(point));
    EXPECT_NE(
        fault.find("materials.wood.axes: cell 4 (QUAD8) at (1.5, 0.785398) lies on the line about which "
                   "the axes turn, where they have no direction"),
        std::string::npos)
        << fault;
  }
}

TEST(CylindricalAxes, MayHaveTheirLineAtAnEdgeOrACornerOfACell) {
  for (const auto* point : {"[1, 0]", "[1, 0.5]", "[0.999, 0.5]"})
    EXPECT_EQ(told(with_point(point)), "nothing thrown") << point;
}

} // namespace
} // namespace rubato::simulation::cylindrical_axes_test
