// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact patch test (R. L. Taylor and P. Papadopoulos 1991; N. El-Abbasi and K.-J. Bathe, Comput.
/// Struct. 79, 2001): two blocks of side 1 on one another, pressed together by 0.1. With E = 2e6 and ν = 0
/// the strain is 0.05, the pressure 1e5 everywhere, and the interface moves by −0.05.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include "unit/step/walk.hpp"
#include <cmath>
#include <string>

namespace rubato::test {

/// Cells of each block along every direction; equal numbers make a conforming interface.
struct ContactBlocks {
  mesh::CellType cells = mesh::CellType::quad4;
  int upper = 2;
  int lower = 2;
  double friction = 0;
  std::string zone; ///< further entries of the contact zone, each with a comma before it
};

struct PatchOutcome {
  bool converged = false;
  std::string failure;
  double pressure = 0;     ///< largest |λ/1e5 − 1|
  double displacement = 0; ///< largest |u_y + 0.05|/0.1 on the slave surface
};

inline std::string deck_of(const ContactBlocks& blocks) {
  const auto& cell = mesh::topology(blocks.cells);
  const bool solid = cell.dimension == 3;
  std::string cells(cell.name);
  for (auto& letter : cells)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  const auto body = [&](const char* name, int from, int n, const char* sides) {
    return fmt::format(
        "    - {{name: {0}, {1}: {{from: [0, {2}{3}], to: [1, {4}{5}]}}, divisions: [{6}, {6}{7}], "
        "cells: {8}, sides: {{left: left, {9}{10}}}}}\n",
        name, solid ? "box" : "rectangle", from, solid ? ", 0" : "", from + 1, solid ? ", 1" : "", n,
        solid ? fmt::format(", {}", n) : "", cells, sides, solid ? ", back: back" : "");
  };
  const std::string others = solid ? "x, z" : "x";
  // Friction holds what the sides would hold as well: one of the two.
  const auto sides =
      blocks.friction > 0
          ? fmt::format("  - {{on: ground, fix: [{0}]}}\n  - {{on: roof, fix: [{0}]}}\n", others)
          : fmt::format("  - {{on: left, fix: x}}\n{}", solid ? "  - {on: back, fix: z}\n" : "");
  return fmt::format(R"(mesh:
  generate:
{}{}physics: {}
materials: {{rubber: {{young: 2e6, poisson: 0}}}}
supports:
  - {{on: ground, fix: y}}
  - {{on: roof, y: -0.1}}
{}contact: {{interface: {{master: lower_face, slave: upper_face, friction: {}{}}}}}
time: {{scheme: static, step: 1, end: 1}}
newton: {{residual: 1e-12}}
)",
                     body("lower", 0, blocks.lower, "bottom: ground, top: lower_face"),
                     body("upper", 1, blocks.upper, "top: roof, bottom: upper_face"),
                     solid ? "solid" : "plane_strain", sides, blocks.friction, blocks.zone);
}

inline PatchOutcome press(const ContactBlocks& blocks) {
  PatchOutcome outcome;
  Walk walk(deck_of(blocks), {{"time.on_failure", "{levels: 0}"}});
  outcome.converged = walk.to_end();
  if (!outcome.converged) {
    outcome.failure = step::to_string(walk.reports.back().outcome);
    return outcome;
  }
  for (std::size_t i = 0; i < walk.slave_count(); ++i) {
    outcome.pressure = std::max(outcome.pressure, std::abs(walk.pressure(i) / 1e5 - 1));
    const double u = walk.displacement(walk.model.zones.front().slave.nodes[i], 1);
    outcome.displacement = std::max(outcome.displacement, std::abs(u + 0.05) / 0.1);
  }
  return outcome;
}

} // namespace rubato::test
