// SPDX-License-Identifier: LGPL-3.0-or-later
/// Decks the tests change bit by bit, and what they ask of them.
#pragma once

#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::test {

/// Nothing but what every deck must say.
inline const std::string smallest_deck = R"(mesh: {file: beams.med}
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
time: {scheme: newmark, step: 1e-3, end: 0.012}
)";

/// Every key of the grammar at least once, with values other than the defaults.
inline const std::string full_deck = R"(title: two beams
units: mm, N, s
mesh:
  generate:
    - name: upper
      rectangle: {from: [0, 0.1], to: [1, 0.2]}
      divisions: [20, 2]
      cells: quad8
      sides: {left: Clamped, bottom: Below, right: End, top: Above}
      points: {right_top: Force, left_bottom: P}
    - name: lower
      rectangle: {from: [0, 0], to: [1, 0.1]}
      divisions: [20, 3]
      sides: {top: Beneath}
  convert: full_quadratic
  refine: 2
physics: plane_stress
thickness: 0.5
materials:
  steel:
    young: 200e9
    poisson: 0.25
    density: 7800
    rayleigh: {stiffness: 1e-5, mass: 2}
    cells: [upper, lower]
supports:
  - {on: Clamped, fix: [x, y]}
  - {on: End, x: 0.1, y: {value: 0.2, function: ramp}}
loads:
  - nodal_force: {on: Force, y: -1e7, function: ramp}
  - line_force: {on: Above, x: 1}
  - surface_force: {on: Above, x: 2, y: 3}
  - pressure: {on: Above, value: 4, function: hold}
  - gravity: {y: -9.81, on: upper}
springs:
  - {on: End, x: 1e4, y: 2e4}
initial:
  - {on: lower, velocity: {x: -10, y: 1}}
  - {on: Force, displacement: {y: 1e-3}, velocity: {y: 2}}
functions:
  ramp: {times: [0, 1, 2], values: [0, 1, 0.5], outside: linear}
  hold: {times: [0], values: [1], outside: zero}
contact:
  interface:
    master: Below
    slave: Beneath
    friction: 0.2
    method: augmented_lagrangian
    normal: average
    integration: {gauss: 3}
    clamped_normal: code_aster
    exclude_nodes: [Clamped, N6]
    initially_active: false
    coefficients: {normal: 1e9, tangential: 1e7}
    friction_method: penalty
    iterate: {geometry: {by: fixed_point, tolerance: 2e-3, max_loops: 7}, friction: newton, status: fixed_point}
    history_force: false
time:
  scheme: hht
  alpha: -0.3
  begin: 0.001
  step: 1e-3
  end: 0.013
  start: consistent
  on_failure: {cut: 4, levels: 6}
newton: {max_iterations: 25, residual: 1e-9}
probes:
  tip: {node: Force, field: velocity}
  middle: {point: [0.5, 0.15], field: reaction}
fields: {formats: [vtu, med], at: [0.001, 0.006], every: 10, last: false}
checkpoint: {at: [0.002], every: 20, last: false}
checks:
  - {probe: tip.y, at: 0.012, reference: -0.0132, tolerance: 1e-3, kind: absolute, source: other_code, note: table 3}
)";

inline std::string replaced(std::string text, std::string_view old, std::string_view replacement) {
  const auto at = text.find(old);
  if (at == std::string::npos)
    throw std::logic_error("the sample deck has no " + std::string(old));
  return text.replace(at, old.size(), replacement);
}

/// "study.yaml:line:column" of the first place where `marker` stands in the text.
inline std::string place_of(std::string_view text, std::string_view marker) {
  const auto at = text.find(marker);
  if (at == std::string_view::npos)
    throw std::logic_error("the deck has no " + std::string(marker));
  const auto before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const auto column = at - (before.rfind('\n') + 1) + 1;
  return "study.yaml:" + std::to_string(line) + ":" + std::to_string(column);
}

inline deck::Deck parse(std::string_view text, const std::vector<deck::Setting>& settings = {}) {
  return deck::parse_deck(text, "study.yaml", settings);
}

inline study::Study parse_one(std::string_view text, const std::vector<deck::Setting>& settings = {}) {
  return parse(text, settings).runs.at(0);
}

/// "place: sentence" of every fault; empty when there is none.
inline std::vector<std::string> faults_of(std::string_view text,
                                          const std::vector<deck::Setting>& settings = {}) {
  std::vector<std::string> sentences;
  try {
    parse(text, settings);
  } catch (const InputError& error) {
    for (const auto& fault : error.faults())
      sentences.push_back(to_string(fault.at) + ": " + fault.text);
  }
  return sentences;
}

using Sentences = std::vector<std::string>;

/// Of a contact zone with these words, without the place.
inline Sentences faults_of_zone(const std::string& settings) {
  Sentences sentences;
  for (const auto& sentence :
       faults_of(smallest_deck + "contact: {a: {master: M, slave: S, " + settings + "}}\n"))
    sentences.push_back(sentence.substr(sentence.find("contact")));
  return sentences;
}

/// Of an explicit run with these words after `scheme` in `time`, and these beside it in the deck.
inline Sentences faults_of_explicit(const std::string& time, const std::string& beside = "") {
  Sentences sentences;
  for (const auto& sentence :
       faults_of(replaced(smallest_deck, "newmark, step: 1e-3, end: 0.012", "central_difference, " + time) +
                 beside))
    sentences.push_back(sentence.substr(sentence.find(": ") + 2));
  return sentences;
}

} // namespace rubato::test
