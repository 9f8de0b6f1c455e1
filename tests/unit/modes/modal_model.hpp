// SPDX-License-Identifier: LGPL-3.0-or-later
/// The model of a deck whose modes are wanted.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/modes/modal_study.hpp"
#include "rubato/modes/modes.hpp"

#include "support/model_of.hpp"
#include <string>
#include <vector>

namespace rubato::test {

/// Of its first run.
inline test::BuiltModel modal_model(const std::string& deck, const std::vector<deck::Setting>& changes = {}) {
  return test::BuiltModel(modes::modal_study(deck::parse_deck(deck, "deck.yaml", changes).runs.front()));
}

/// A block of cells on another one of the same width: meshes match or not, as `divisions` of the upper one.
inline std::string stacked_blocks(const std::string& divisions, const std::string& zone) {
  return R"(
mesh:
  generate:
    - {name: low, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2], cells: hexa8, sides: {bottom: ground, top: over}}
    - {name: high, box: {from: [0, 1, 0], to: [1, 2, 1]}, divisions: )" +
         divisions + R"(, cells: hexa8, sides: {bottom: under}}
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
supports: [{on: ground, fix: [x, y, z]}]
contact: {joint: {master: over, slave: under, )" +
         zone + R"(}}
time: {scheme: newmark, step: 1, end: 1}
)";
}

/// The two blocks as one.
inline const std::string one_block = R"(
mesh:
  generate:
    - {name: low, box: {from: [0, 0, 0], to: [1, 2, 1]}, divisions: [2, 4, 2], cells: hexa8, sides: {bottom: ground}}
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
supports: [{on: ground, fix: [x, y, z]}]
time: {scheme: newmark, step: 1, end: 1}
)";

} // namespace rubato::test
