// SPDX-License-Identifier: LGPL-3.0-or-later
#include "patch/contact_blocks.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

namespace rubato::test {
namespace {

Eigen::AngleAxisd rotation_of(const ContactBlocks& blocks) {
  const bool solid = cell::topology(blocks.cells).dimension == 3;
  return {blocks.turned, solid ? Eigen::Vector3d(1, 0.5, 2).normalized() : Eigen::Vector3d::UnitZ()};
}

} // namespace

std::string deck_of(const ContactBlocks& blocks) {
  const bool solid = cell::topology(blocks.cells).dimension == 3;
  const auto word = [](CellType type) {
    std::string cells(cell::topology(type).name);
    for (auto& letter : cells)
      letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
    return cells;
  };
  const auto body = [&](const char* name, CellType type, int from, int n, const char* sides) {
    return fmt::format(
        "    - {{name: {0}, {1}: {{from: [0, {2}{3}], to: [1, {4}{5}]}}, divisions: [{6}, {6}{7}], "
        "cells: {8}, sides: {{left: left, {9}{10}}}}}\n",
        name, solid ? "box" : "rectangle", from, solid ? ", 0" : "", from + 1, solid ? ", 1" : "", n,
        solid ? fmt::format(", {}", n) : "", word(type), sides, solid ? ", back: back" : "");
  };
  const std::string others = solid ? "x, z" : "x";
  const Eigen::Vector3d up = rotation_of(blocks) * Eigen::Vector3d::UnitY();
  const auto push = fmt::format("x: {:.17g}, y: {:.17g}{}", -0.1 * up[0], -0.1 * up[1],
                                solid ? fmt::format(", z: {:.17g}", -0.1 * up[2]) : "");
  const auto ends =
      blocks.turned == 0
          ? std::string("  - {on: ground, fix: y}\n  - {on: roof, y: -0.1}\n")
          : fmt::format("  - {{on: ground, fix: [{}, y]}}\n  - {{on: roof, {}}}\n", others, push);
  // Friction holds what the sides would hold as well: one of the two. Turned blocks are held at both ends.
  const auto sides =
      blocks.turned != 0 ? std::string()
      : blocks.friction > 0
          ? fmt::format("  - {{on: ground, fix: [{0}]}}\n  - {{on: roof, fix: [{0}]}}\n", others)
          : fmt::format("  - {{on: left, fix: x}}\n{}", solid ? "  - {on: back, fix: z}\n" : "");
  return fmt::format(R"(mesh:
  generate:
{}{}physics: {}
materials: {{rubber: {{young: 2e6, poisson: 0}}}}
supports:
{}{}contact: {{interface: {{master: lower_face, slave: upper_face, friction: {}{}}}}}
time: {{scheme: static, step: 1, end: 1}}
newton: {{residual: 1e-12}}
)",
                     body("lower", blocks.lower_cells.value_or(blocks.cells), 0, blocks.lower,
                          "bottom: ground, top: lower_face"),
                     body("upper", blocks.cells, 1, blocks.upper, "top: roof, bottom: upper_face"),
                     solid ? "solid" : "plane_strain", ends, sides, blocks.friction, on_nodes(blocks.zone));
}

PatchOutcome press(const ContactBlocks& blocks) {
  PatchOutcome outcome;
  const std::vector<deck::Setting> no_cuts{{"time.on_failure", "{levels: 0}"}};
  const auto study = deck::parse_deck(deck_of(blocks), "deck.yaml", no_cuts).runs.front();
  auto mesh = model::load_mesh(study.mesh);
  if (blocks.change)
    mesh = blocks.change(mesh);
  const Eigen::AngleAxisd rotation = rotation_of(blocks);
  for (auto& point : mesh.points)
    point = rotation * point;
  Walk walk(study, std::move(mesh));
  outcome.converged = walk.to_end();
  if (!outcome.converged) {
    outcome.failure = step::to_string(walk.reports.back().outcome);
    return outcome;
  }
  for (std::size_t i = 0; i < walk.slave_count(); ++i) {
    outcome.pressure = std::max(outcome.pressure, std::abs(walk.pressure(i) / 1e5 - 1));
    const auto node = walk.model.zones.front().slave.nodes[i];
    Eigen::Vector3d moved = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < walk.model.dofs.components; ++axis)
      moved[axis] = walk.displacement(node, axis);
    const double u = moved.dot(rotation * Eigen::Vector3d::UnitY());
    outcome.displacement = std::max(outcome.displacement, std::abs(u + 0.05) / 0.1);
  }
  return outcome;
}

} // namespace rubato::test
