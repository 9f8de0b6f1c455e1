// SPDX-License-Identifier: LGPL-3.0-or-later
/// A deck with all that holds and drives bodies: groups, fields, relations, discrete parts, heat.
#pragma once

#include <string>

namespace rubato::test {

/// Valid, of few nodes; a model can be built of it.
inline const std::string driven_deck = R"deck(title: all that holds and drives
mesh:
  generate:
    - name: low
      rectangle: {from: [0, 0], to: [4, 1]}
      divisions: [4, 1]
      sides: {bottom: ground, top: table, left: west, right: east}
      points: {left_top: pin}
    - name: up
      rectangle: {from: [1, 1], to: [3, 2]}
      divisions: [3, 2]
      sides: {bottom: sole, top: roof, left: back, right: face}
  groups:
    corner: {box: {from: [2.9, 1.9], to: [3.1, 2.1]}}
    facing: {box: {from: [-0.1, 0.9], to: [0.1, 1.1]}}
physics: plane_strain
materials:
  wood: {law: orthotropic, young_x: 1e5, young_y: "5e4 + 1e3*x", young_z: 4e4, poisson_xy: 0.2, poisson_yz: 0.1, poisson_xz: 0.1, shear_xy: 2e4, angle_z: 20, axes: {cylindrical: {point: [-3, -2]}}, density: 1, expansion: [1e-5, 2e-5, 3e-5], reference_temperature: 20, cells: low}
  steel: {young: {along: y, at: [1, 2], values: [2e5, 1e5]}, poisson: 0.3, density: "1 + 0.1*y", expansion: 1e-5, damping: {ratio: [0.01, 0.02], at: [50, 400]}, cells: up}
functions:
  rise: {ramp: {begin: 0, end: 1e-3, from: 0, to: 1}}
  wave: {sine: {frequency: 200, amplitude: 1, phase: 0, mean: 0}}
  both: {product: [rise, wave]}
  law: {expression: "t*(1 - t)"}
  table: {times: [0, 1e-3], values: [0, 1]}
base_motion: {x: {acceleration: 1, function: wave}, frame: relative}
supports:
  - {on: ground, fix: [x, y]}
  - {on: facing, x: {velocity: 0.1, function: rise}, until: 2e-3}
  - {on: cap, along: [1, 1], value: {value: "1e-4*x", function: wave}}
relations:
  cap: {rigid: {on: roof}}
  mean: {distributed: {on: face, at: [3, 1.5]}}
  place: {embedded: {at: [0.6, 0.4], in: low}}
  lever: {equation: {terms: [{on: N9, y: 1}, {on: N8, y: -2}], value: {value: 1e-5, function: rise}}}
preload: {bolt: {cut: {point: [2, 1.5], normal: [0, 1], cells: up}, force: 5, function: rise, lock: 2.5e-3}}
connectors:
  - {on: place, along: [0, 1], stiffness: 100, damping: 1}
  - {on: mean, to: place, force: {elongations: [-1, 0, 1], forces: [-10, 0, 100]}, damper: {rates: [-1, 1], forces: [-1, 2]}}
masses:
  - {on: mean, mass: 0.1, inertia: [0, 0, 0.2]}
  - {on: N10, mass: 0.1}
springs: [{on: east, x: 10}]
modal_damping: {modes: 2, ratio: [0.01, 0.02]}
temperature:
  - {on: all, value: 20}
  - {on: up, value: "20 + 10*x*t/1e-3"}
loads:
  - nodal_force: {on: place, y: -1, function: both}
  - moment: {on: mean, z: 1, function: law}
  - pressure: {on: face, value: "100*y", function: table}
  - gravity: {y: -9.81}
contact:
  joint: {master: table, slave: sole, friction: {along: x, at: [1, 3], values: [0.1, 0.3]}, gap: "1e-4*(x - 2)^2", interference: {value: 1e-5, function: rise}}
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 3e-3}
probes:
  grip: {contact: {zone: joint, about: [2, 1]}}
  push: {on: sole, field: contact_force}
  heat: {on: up, take: max, field: temperature}
  turn: {node: cap, field: rotation}
  cut: {section: {point: [2, 0.5], normal: [1, 0], cells: low}}
fields: {also: [internal_force, contact_force, reaction]}
)deck";

} // namespace rubato::test
