// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/mortar_patch.hpp"

#include "rubato/contact/mortar/operators.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/report.hpp"

#include "patch/contact_blocks.hpp"
#include "support/patch_mesh.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace rubato::verification {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using mesh::Mesh;
using mesh::NodeIndex;

constexpr double pressure = 1e5;
constexpr double push = 0.1;
constexpr double smaller = 0.6;

bool is_thrown(Layout layout) {
  return layout == Layout::distorted || layout == Layout::curved;
}

bool hangs_over(Layout layout) {
  return layout == Layout::master_over || layout == Layout::slave_over || layout == Layout::both_over;
}

Vector3d& point_of(Mesh& mesh, NodeIndex node) {
  return mesh.points[static_cast<std::size_t>(node)];
}

/// Where columns of nodes inside a block's outline stand, different in the two blocks.
Vector3d thrown(const Vector3d& x, bool upper, bool solid) {
  const double pi = std::numbers::pi;
  const double sign = upper ? 1 : -0.8;
  const double across = std::sin(pi * x.x()) * (solid ? std::sin(pi * x.z()) : 1.0);
  Vector3d moved = x;
  moved.x() += sign * 0.08 * across * (1 + (solid ? x.z() : 0.0));
  if (solid)
    moved.z() += sign * 0.07 * across * (1 - 2 * x.x());
  return moved;
}

/// Puts every node that is no corner between the corners of its cell.
void straighten(Mesh& mesh, const std::set<NodeIndex>& among) {
  for (const auto& block : mesh.blocks) {
    const auto& topology = cell::topology(block.type);
    if (topology.order < 2 || topology.dimension != mesh.dimension)
      continue;
    const auto& cell = cell::reference_cell(block.type);
    const auto& linear = cell::reference_cell(test::corner_type(topology));
    const auto corners = static_cast<std::size_t>(topology.corner_count);
    std::vector<double> share(corners);
    for (std::size_t first = 0; first < block.nodes.size(); first += cell.nodes.size())
      for (std::size_t i = corners; i < cell.nodes.size(); ++i) {
        const auto node = block.nodes[first + i];
        if (!among.contains(node))
          continue;
        linear.values(cell.nodes[i], share);
        Vector3d place = Vector3d::Zero();
        for (std::size_t c = 0; c < corners; ++c)
          place += share[c] * point_of(mesh, block.nodes[first + c]);
        point_of(mesh, node) = place;
      }
  }
}

/// Nodes between corners go off their chords within planes y = constant, as long as no outline bends.
void bend(Mesh& mesh, const std::set<NodeIndex>& corners, bool solid) {
  for (NodeIndex node = 0; node < mesh.node_count(); ++node) {
    auto& x = point_of(mesh, node);
    const double pi = std::numbers::pi;
    if (corners.contains(node))
      continue;
    const double inside = std::sin(pi * x.x()) * (solid ? std::sin(pi * x.z()) : 1.0);
    x.x() += 0.015 * inside * std::cos(7 * x.x());
    if (solid)
      x.z() += 0.015 * inside * std::cos(5 * x.z());
  }
}

std::set<NodeIndex> corners_of(const Mesh& mesh) {
  std::set<NodeIndex> corners;
  for (const auto& block : mesh.blocks) {
    const auto& topology = cell::topology(block.type);
    const auto count = static_cast<std::size_t>(topology.node_count);
    if (topology.dimension == mesh.dimension)
      for (std::size_t first = 0; first < block.nodes.size(); first += count)
        corners.insert(block.nodes.begin() + static_cast<std::ptrdiff_t>(first),
                       block.nodes.begin() + static_cast<std::ptrdiff_t>(first) + topology.corner_count);
  }
  return corners;
}

Mesh throw_about(Mesh mesh, bool curved) {
  const bool solid = mesh.dimension == 3;
  const auto corners = corners_of(mesh);
  std::set<NodeIndex> others;
  for (const auto* body : {"lower", "upper"})
    for (const auto node : mesh::nodes_named(mesh, body)) {
      point_of(mesh, node) = thrown(point_of(mesh, node), *body == 'u', solid);
      if (!corners.contains(node))
        others.insert(node);
    }
  straighten(mesh, others);
  if (curved)
    bend(mesh, corners, solid);
  return mesh;
}

/// One block smaller, or as it is, turned about the push through the middle of both.
Mesh hung_over(Mesh mesh, Layout layout) {
  const bool solid = mesh.dimension == 3;
  const double size = layout == Layout::both_over ? 1 : smaller;
  const Vector3d centre(0.5, 0, solid ? 0.5 : 0);
  const Vector3d moved(!solid && layout == Layout::both_over ? 0.28 : 0, 0, 0);
  const Eigen::AngleAxisd turn(solid ? std::numbers::pi / 9 : 0, Vector3d::UnitY());
  for (const auto node : mesh::nodes_named(mesh, layout == Layout::slave_over ? "lower" : "upper")) {
    auto& x = point_of(mesh, node);
    const double height = x.y();
    x = centre + moved + turn * (size * (x - centre));
    x.y() = height;
  }
  return mesh;
}

Mesh laid(const Mesh& mesh, Layout layout) {
  if (is_thrown(layout))
    return throw_about(mesh, layout == Layout::curved);
  return hangs_over(layout) ? hung_over(mesh, layout) : mesh;
}

contact::mortar::Operators operators_of(const model::Model& model) {
  const auto& zone = model.zones.front();
  const auto places = [&](const contact::Surface& surface) {
    std::vector<Vector3d> x;
    for (const auto node : surface.nodes)
      x.push_back(model.mesh.points[static_cast<std::size_t>(node)]);
    return x;
  };
  return contact::mortar::integrate(zone.slave, *zone.mortar, zone.master, places(zone.slave),
                                    places(zone.master), {.held = zone.held});
}

/// Takes the part of the pressure that contact carries, p B along the push, from that on the whole surfaces.
void unload_covered(model::Model& model, const contact::mortar::Operators& operators) {
  VectorXd& load = model.forces.front().pattern;
  for (const auto& node : operators.nodes)
    for (std::size_t i = 0; i < node.stencil.nodes.size(); ++i)
      load[model.dofs.dof(node.stencil.nodes[i], 1)] -=
          pressure * node.weight * node.stencil.weights[static_cast<Eigen::Index>(i)];
}

PatchDeviation deviation_of(const test::Walk& walk, const contact::mortar::Operators& operators) {
  PatchDeviation found;
  const auto& zone = walk.model.zones.front();
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    if (operators.nodes[i].kept())
      found.pressure = std::max(found.pressure, std::abs(walk.pressure(i) / pressure - 1));
  for (const auto* surface : {&zone.slave, &zone.master})
    for (const auto node : surface->nodes)
      found.displacement =
          std::max(found.displacement, std::abs(walk.displacement(node, 1) + push / 2) / push);
  return found;
}

} // namespace

std::string_view name_of(Layout layout) {
  constexpr std::array<std::string_view, layouts.size()> names{
      "3 on 4", "5 on 4", "distorted", "master over", "slave over", "both over", "curved edges"};
  return names[static_cast<std::size_t>(layout)];
}

PatchDeviation press_by_mortar(CellType slave, CellType master, Layout layout) {
  test::ContactBlocks blocks{slave, layout == Layout::five_on_four ? 5 : 3, 4, 0, ", integration: mortar"};
  blocks.lower_cells = master;
  std::vector<deck::Setting> settings{{"time.on_failure", "{levels: 0}"}};
  if (is_thrown(layout)) // segments cut otherwise change integrals over distorted quadrangles by that much
    settings.push_back({"newton.residual", "1e-10"});
  if (hangs_over(layout))
    settings.push_back(
        {"loads", "[{pressure: {on: lower_face, value: 1e5}}, {pressure: {on: upper_face, value: 1e5}}]"});
  const auto study = deck::parse_deck(test::deck_of(blocks), "deck.yaml", settings).runs.front();
  auto model = model::build_model(study, laid(model::load_mesh(study.mesh), layout));
  const auto operators = operators_of(model);
  if (hangs_over(layout))
    unload_covered(model, operators);
  test::Walk walk(std::move(model));
  if (!walk.to_end()) {
    PatchDeviation failed;
    failed.failure = step::to_string(walk.reports.back().outcome);
    return failed;
  }
  auto found = deviation_of(walk, operators);
  found.iterations = walk.reports.back().iterations;
  return found;
}

} // namespace rubato::verification
