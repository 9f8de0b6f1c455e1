// SPDX-License-Identifier: LGPL-3.0-or-later
/// Small bodies in contact, as decks.
#pragma once

#include <string>

namespace rubato::test {

/// Entries of a contact zone, with contact points on the nodes unless they say where or tie.
inline std::string on_nodes(const std::string& zone) {
  const auto has = [&](const char* key) { return zone.find(key) != std::string::npos; };
  return has("integration:") || has("tie:") ? zone : zone + ", integration: nodes";
}

/// A block of side 1 on a longer foundation, pressed down by 1000 N in all and pushed sideways at its top by
/// a distance that grows with pseudo-time t from 0 to 1. Both are stiff: strains stay below 1e-5.
inline const std::string block_on_plane = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [4, 4], cells: quad4,
       sides: {top: top, bottom: under}}
    - {name: plane, rectangle: {from: [-1, -1], to: [4, 0]}, divisions: [13, 2], cells: quad4,
       sides: {top: over, bottom: ground}}
physics: plane_stress
materials: {stone: {young: 1e9, poisson: 0, density: 2000}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports:
  - {on: ground, fix: [x, y]}
  - {on: top, x: {value: 1e-6, function: ramp}}
loads: [{surface_force: {on: top, y: -1000}}]
contact: {foot: {master: over, slave: under, integration: nodes, friction: 0.3}}
time: {scheme: static, step: 0.25, end: 1}
)";

/// A block that is pressed onto a plane that cannot be deformed and pushed along it.
inline const std::string block_on_obstacle = R"(
mesh:
  generate:
    - {name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2], sides: {back: top, front: under}}
physics: solid
materials: {stone: {young: 1e6, poisson: 0.2, density: 2000}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: top, x: {value: 0.02, function: ramp}, y: {value: 0.01, function: ramp}}]
loads: [{surface_force: {on: top, z: -1000}}]
contact: {foot: {obstacle: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}, slave: under, friction: 0.3}}
time: {scheme: static, step: 0.1, end: 1}
)";

/// SDNL140's two beams in plane stress, with a true start.
inline const std::string two_beams = R"(
mesh:
  generate:
    - {name: upper, rectangle: {from: [0, 0], to: [1, 0.1]}, divisions: [20, 2], cells: quad4,
       sides: {left: clamp, bottom: upper_face}, points: {right_top: force}}
    - {name: lower, rectangle: {from: [0, -0.1], to: [1, 0]}, divisions: [20, 2], cells: quad4,
       sides: {left: clamp, top: lower_face}}
physics: plane_stress
materials: {steel: {young: 200e9, poisson: 0, density: 7800}}
supports: [{on: clamp, fix: [x, y]}]
loads: [{nodal_force: {on: force, y: -1e7}}]
contact: {interface: {master: upper_face, slave: lower_face, integration: nodes, friction: 0.2, exclude_nodes: [clamp]}}
time: {scheme: hht, alpha: -0.3, step: 1e-3, end: 0.012}
newton: {residual: 1e-10}
)";

/// Three blocks of side 1 on one another, the top one pressed down by 0.03.
inline const std::string three_blocks = R"(
mesh:
  generate:
    - {name: low, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [3, 2], sides: {bottom: ground, left: left, top: low_top}}
    - {name: mid, rectangle: {from: [0, 1], to: [1, 2]}, divisions: [3, 2], sides: {bottom: mid_bottom, left: left, top: mid_top}}
    - {name: high, rectangle: {from: [0, 2], to: [1, 3]}, divisions: [3, 2], sides: {bottom: high_bottom, left: left, top: roof}}
physics: plane_strain
materials: {rubber: {young: 2e6, poisson: 0, density: 1000}}
supports:
  - {on: ground, fix: y}
  - {on: left, fix: x}
  - {on: roof, y: -0.03}
contact:
  below: {master: low_top, slave: mid_bottom, integration: nodes}
  above: {master: high_bottom, slave: mid_top, integration: nodes}
time: {scheme: static, step: 1, end: 1}
)";

} // namespace rubato::test
