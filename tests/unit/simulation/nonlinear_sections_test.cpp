// SPDX-License-Identifier: LGPL-3.0-or-later
/// Forces that nonlinear bodies transmit where they are cut, against loads, reactions and inertia.
#include "rubato/domain/cut.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/model_forces.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/solid_materials.hpp"
#include "support/walk.hpp"
#include <string>
#include <tuple>

namespace rubato::simulation::nonlinear_sections_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// A cantilever of two materials one after the other, cut in both and where they meet.
const std::string cantilever = R"(
mesh:
  generate: [{name: beam, rectangle: {from: [0, 0], to: [4, 1]}, divisions: [8, 2], cells: quad4,
              sides: {left: held}, points: {right_top: tip}}]
  groups:
    root: {box: {from: [0, 0], to: [2, 1]}, of: beam, take: cells}
    end: {box: {from: [2, 0], to: [4, 1]}, of: beam, take: cells}
physics: plane_strain
materials:
  first: {young: 1000, poisson: 0.3, density: 1, cells: root}
  second: {young: 1000, poisson: 0.3, density: 1, cells: end}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: held, fix: [x, y]}]
loads: [{nodal_force: {on: tip, x: 2, y: -3, function: ramp}}]
TIME
probes:
  in_first: {section: {point: [1, 0.5], normal: [1, 0]}}
  between: {section: {point: [2, 0.25], normal: [1, 0]}}
  in_second: {section: {point: [3, 0], normal: [1, 0]}}
  clamp: {section: {on: held, point: [0, 0], normal: [-1, 0]}}
)";

const std::string steady = "time: {scheme: static, step: 0.25, end: 1}";
const std::string moving = "time: {scheme: newmark, step: 0.25, end: 1}";

study::Study study_with(const std::string& time) {
  auto deck = cantilever;
  deck.replace(deck.find("TIME"), 4, time);
  return test::study_of(deck);
}

/// Force and moment, mz alone, of a probe.
Vector3d transmitted(const test::Walk& walk, std::size_t probe) {
  const auto& state = walk.state();
  const auto forces = domain::forces_at(walk.model.probe_cuts[probe], state.motion.u,
                                        {walk.model.domain.heat(), state.t}, &state.bulk_points);
  return {forces[0], forces[1], forces[5]};
}

Vector3d about(const Vector3d& arm, const Vector3d& force) {
  return {force[0], force[1], arm.cross(force)[2]};
}

Vector3d moved(const test::Walk& walk, mesh::NodeIndex node, bool deformed) {
  Vector3d place = walk.model.mesh.points[static_cast<std::size_t>(node)];
  if (deformed)
    place.head<2>() += walk.state().motion.u.segment<2>(walk.model.dofs.dof(node, 0));
  return place;
}

/// What acts on the nodes with x ≥ from, about a point: loads less inertia. Cells in front of a cut through
/// these nodes have no resultant.
Vector3d in_front(const test::Walk& walk, double from, const Vector3d& point, bool deformed) {
  const auto& model = walk.model;
  VectorXd force = model::external_force(model, walk.state().t);
  if (walk.scheme.dynamic)
    force -= model.mass * walk.state().motion.a;
  Vector3d sum = Vector3d::Zero();
  for (const auto node : model.dofs.nodes)
    if (model.mesh.points[static_cast<std::size_t>(node)][0] > from - 1e-9) {
      Vector3d at_node = Vector3d::Zero();
      at_node.head<2>() = force.segment<2>(model.dofs.dof(node, 0));
      sum += about(moved(walk, node, deformed) - point, at_node);
    }
  return sum;
}

void make_logarithmic(study::Study& study) {
  for (auto& material : study.materials)
    test::make_plastic(material, 20, 50, study::StrainKind::logarithmic);
}

void expect_near(const Vector3d& value, const Vector3d& expected, double part) {
  EXPECT_NEAR((value - expected).norm(), 0, part * expected.norm())
      << value.transpose() << " instead of " << expected.transpose();
}

/// Moments about the place where the tip is: the part in front of the cut is in balance there only.
TEST(SectionsOfNonlinearBodies, AreInBalanceWithTheLoadOnTheDeformedBody) {
  auto study = study_with(steady);
  make_logarithmic(study);
  test::Walk walk(study);
  walk.to_end();
  EXPECT_GT(walk.state().motion.u.lpNorm<Eigen::Infinity>(), 0.3);
  EXPECT_GT(walk.state().bulk_points.values.size(), 0U);
  const Vector3d load(2, -3, 0);
  const auto tip = mesh::find_nodes(walk.model.mesh, "tip").nodes.front();
  for (const auto& [probe, point] : {std::pair{0U, Vector3d(1, 0.5, 0)}, std::pair{1U, Vector3d(2, 0.25, 0)},
                                     std::pair{2U, Vector3d(3, 0, 0)}})
    expect_near(transmitted(walk, probe), about(moved(walk, tip, true) - point, load), 1e-7);
}

/// At the clamp: the reaction, with the sign of a force on the body.
TEST(SectionsOfNonlinearBodies, AreTheReactionsAtASupport) {
  auto study = study_with(steady);
  make_logarithmic(study);
  test::Walk walk(study);
  walk.to_end();
  Vector3d reactions = Vector3d::Zero();
  for (const auto node : mesh::find_nodes(walk.model.mesh, "held").nodes) {
    Vector3d force = Vector3d::Zero();
    force.head<2>() = walk.state().reaction.segment<2>(walk.model.dofs.dof(node, 0));
    reactions += about(moved(walk, node, true), force);
  }
  expect_near(transmitted(walk, 3), reactions, 1e-7);
}

/// Small strains: moments about where bodies were, as those of linear cells.
TEST(SectionsOfNonlinearBodies, AreInBalanceInTheUndeformedBodyOfSmallStrains) {
  auto study = study_with(steady);
  test::make_plastic(study.materials[0], 20, 50); // the other one stays linear
  test::Walk walk(study);
  walk.to_end();
  for (const auto& [probe, x, y] :
       {std::tuple{0U, 1., 0.5}, std::tuple{1U, 2., 0.25}, std::tuple{2U, 3., 0.}})
    expect_near(transmitted(walk, probe), in_front(walk, x, {x, y, 0}, false), 1e-7);
}

TEST(SectionsOfNonlinearBodies, AreInBalanceWithInertia) {
  auto study = study_with(moving);
  make_logarithmic(study);
  test::Walk walk(study);
  walk.to_end();
  EXPECT_GT(walk.state().motion.a.lpNorm<Eigen::Infinity>(), 0.1);
  for (const auto& [probe, x, y] :
       {std::tuple{0U, 1., 0.5}, std::tuple{1U, 2., 0.25}, std::tuple{2U, 3., 0.}})
    expect_near(transmitted(walk, probe), in_front(walk, x, {x, y, 0}, true), 1e-7);
}

} // namespace
} // namespace rubato::simulation::nonlinear_sections_test
