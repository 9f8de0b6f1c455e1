// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/taylor_bar.hpp"

#include "rubato/core/processor_time.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/simulation/time_integration.hpp"

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "verification/quarter_disc.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace rubato::verification {
namespace {

using Eigen::Vector3d;
using mesh::NodeIndex;

constexpr double radius = 3.2e-3, length = 32.4e-3;
constexpr int layers = 25;

const std::string copper = R"(
materials:
  copper:
    law: plastic
    young: 117e9
    poisson: 0.35
    density: 8930
    hardening: {linear: {yield_stress: 400e6, modulus: 100e6}}
    strain: logarithmic
time: {scheme: central_difference, end: 80e-6, record: 1e-6}
)";

/// `supports` begins the list of them, `axis`: the one the rod stands along, `origin`: of the wall.
std::string before_wall(TaylorWall wall, const std::string& supports, const std::string& axis,
                        const std::string& origin, const std::string& normal) {
  if (wall == TaylorWall::sliding)
    return "supports: [" + supports + ", {on: foot, fix: " + axis + "}]\n" +
           "initial: [{on: above, velocity: {" + axis + ": -227}}]\n";
  return "supports: [" + supports + "]\ninitial: [{on: all, velocity: {" + axis + ": -227}}]\n" +
         "contact: {wall: {slave: foot, obstacle: {plane: {point: " + origin + ", normal: " + normal +
         "}}, method: penalty}}\n";
}

study::Study meridian_study(TaylorWall wall) {
  const auto deck = copper + R"(
mesh:
  generate:
    - {name: rod, rectangle: {from: [0, 0], to: [3.2e-3, 32.4e-3]}, divisions: [4, 25],
       sides: {left: axis, bottom: foot}}
  groups: {above: {box: {from: [-1, 1e-4], to: [1, 1]}}}
physics: axisymmetric
)" + before_wall(wall, "{on: axis, fix: x}", "y", "[0, 0]", "[0, 1]");
  return deck::parse_deck(deck, "taylor.yaml").runs.front();
}

study::Study quarter_study(TaylorWall wall) {
  const auto deck =
      copper + "mesh: {file: quarter.med}\nphysics: solid\n" +
      before_wall(wall, "{on: along_y, fix: x}, {on: along_x, fix: y}", "z", "[0, 0, 0]", "[0, 0, 1]");
  return deck::parse_deck(deck, "taylor.yaml").runs.front();
}

mesh::Mesh quarter_mesh() {
  const auto disc = quarter_disc(radius, 2);
  mesh::MeshBuilder builder(3);
  const auto count = static_cast<NodeIndex>(disc.points.size());
  for (int layer = 0; layer <= layers; ++layer)
    for (NodeIndex i = 0; i < count; ++i) {
      const Vector3d x = disc.points[static_cast<std::size_t>(i)] + Vector3d(0, 0, length * layer / layers);
      const std::array node{builder.add_node(x)};
      if (std::abs(x[0]) < 1e-12)
        builder.add_to_node_group("along_y", node);
      if (std::abs(x[1]) < 1e-12)
        builder.add_to_node_group("along_x", node);
      if (layer > 0)
        builder.add_to_node_group("above", node);
    }
  for (const auto& face : disc.cells) {
    for (int layer = 0; layer < layers; ++layer) {
      std::array<NodeIndex, 8> nodes;
      for (std::size_t i = 0; i < 4; ++i) {
        nodes[i] = face[i] + layer * count;
        nodes[i + 4] = nodes[i] + count;
      }
      builder.add_cell(CellType::hexa8, nodes);
    }
    const std::array foot{builder.add_cell(CellType::quad4, face)};
    builder.add_to_cell_group("foot", foot);
  }
  return std::move(builder).build();
}

/// The axis the rod stands along.
Eigen::Index axis_of(const test::ModelParts& model) {
  return model.dofs.components - 1;
}

void measure_shape(const test::ModelParts& model, const Eigen::VectorXd& u, TaylorResult& result) {
  for (const auto node : model.dofs.nodes) {
    Vector3d x = model.mesh.points[static_cast<std::size_t>(node)];
    x.head(model.dofs.components) += u.segment(model.dofs.dof(node, 0), model.dofs.components);
    const auto axis = axis_of(model);
    result.length = std::max(result.length, x[axis]);
    if (const double radius_here = x.head(axis).norm(); radius_here > result.radius) {
      result.radius = radius_here;
      result.edge = x[axis];
    }
  }
}

} // namespace

TaylorBar taylor_bar(TaylorMesh mesh, TaylorWall wall, study::Formulation formulation) {
  auto study = mesh == TaylorMesh::quarter ? quarter_study(wall) : meridian_study(wall);
  study.materials.front().formulation = formulation;
  if (mesh == TaylorMesh::quarter)
    return {std::move(study), quarter_mesh()};
  auto rod = model::load_mesh(study.mesh);
  return {std::move(study), std::move(rod)};
}

TaylorResult run(TaylorBar bar) {
  const test::BuiltModel built(bar.study, std::move(bar.mesh));
  simulation::Simulation simulation(built);
  const test::ModelParts model(simulation.model());
  const double whole = bar.study.physics == study::Physics::solid ? 4 : 1;
  TaylorResult result;
  step::EnergyRecord record;
  const double begin = processor_seconds();
  while (!simulation.finished()) {
    if (!simulation.advance().accepted())
      throw std::runtime_error("the run of Taylor's bar has no end");
    record.note(simulation.state().t, simulation.energy());
  }
  result.seconds = processor_seconds() - begin;
  const auto& energy = simulation.energy();
  result.balance = record.largest_balance / record.largest;
  result.plastic = whole * energy.plastic;
  result.start = whole * energy.start;
  result.scheme = whole * energy.bulk_scheme;
  result.hourglass = whole * energy.hourglass;
  result.steps = simulation.counters().steps;
  result.cells = model.bulk.cells.size();
  measure_shape(model, simulation.state().motion.u, result);
  return result;
}

} // namespace rubato::verification
