// SPDX-License-Identifier: LGPL-3.0-or-later
/// What several threads and ranks compute against one.
#pragma once

#include "rubato/deck/read.hpp"

#include <string>

namespace rubato::test::blocks {

/// Two blocks of 10 × 10 × 8 cubes each, the upper one pressed on the lower one and rubbed along it.
inline study::Study pressed_blocks(const std::string& law, const std::string& settings,
                                   const std::string& pressure = "4e8") {
  const std::string deck = R"(
mesh:
  generate:
    - {name: lower, box: {from: [0, 0, 0], to: [1, 1, 0.8]}, divisions: [10, 10, 8], cells: hexa8, sides: {back: held, front: seat}}
    - {name: upper, box: {from: [0.1, 0.1, 0.8], to: [0.9, 0.9, 1.6]}, divisions: [10, 10, 8], cells: hexa8, sides: {back: foot, front: head}}
physics: solid
materials: {metal: {young: 200e9, poisson: 0.3, density: 7800)" +
                           law + R"(}}
functions: {ramps: {ramp: [0, 1e-4]}}
supports: [{on: held, fix: [x, y, z]}]
loads:
  - pressure: {on: head, value: )" +
                           pressure +
                           R"(, function: ramps}
  - surface_force: {on: head, x: 1e8, y: 2e7}
contact: {joint: {master: seat, slave: foot, friction: 0.2)" +
                           settings;
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

inline const std::string yields = ", law: plastic, hardening: {linear: {yield_stress: 250e6, modulus: 2e9}}";
/// What rounding makes of a factor is seen as far as iterations go.
inline const std::string implicit =
    "}}\ntime: {scheme: newmark, step: 4e-5, end: 3.2e-4}\nnewton: {residual: 1e-10}\n";
inline const std::string explicit_ =
    ", method: penalty}}\ntime: {scheme: central_difference, end: 3e-4, record: 1e-4}\n";

} // namespace rubato::test::blocks
