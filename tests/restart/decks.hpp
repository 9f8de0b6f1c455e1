// SPDX-License-Identifier: LGPL-3.0-or-later
/// Short runs that carry everything there is from step to step.
#pragma once

#include <string>

namespace rubato::test {

/// SDNL140's beams on a coarse mesh: they hit, rub, part and slide off each other's ends; steps fail and are
/// cut; a second run starts from the end of the first, a third has other methods.
inline const std::string rubbing_beams = R"(title: two beams rubbing
mesh:
  generate:
    - name: Haut
      rectangle: {from: [0, 0], to: [1, 0.1]}
      divisions: [20, 2]
      sides: {left: Encastrement, bottom: Haut_Contact}
      points: {right_top: Force}
    - name: Bas
      rectangle: {from: [0, -0.1], to: [1, 0]}
      divisions: [20, 2]
      sides: {left: Encastrement, top: Bas_Contact}
physics: plane_stress
thickness: 1
materials:
  steel: {young: 200e9, poisson: 0, density: 7800, cells: all, rayleigh: {mass: 5}}
supports:
  - {on: Encastrement, fix: [x, y]}
loads:
  - nodal_force: {on: Force, y: -1e7}
contact:
  interface:
    master: Haut_Contact
    slave: Bas_Contact
    integration: nodes
    friction: 0.2
    exclude_nodes: [Encastrement]
time: {scheme: hht, alpha: -0.1, step: 5e-4, end: 0.03}
probes:
  tip: {node: Force}
  speed: {node: Force, field: velocity}
fields: {formats: [vtu, med, vtkhdf], every: 7}
checkpoint: {every: 5}
runs:
  exact:
    checkpoint: {at: [0.0115]}
    checks: [{probe: tip.y, at: 0.006, reference: -0.15, tolerance: 1}]
  rougher:
    contact: {interface: {friction: 0.5, iterate: {friction: fixed_point}}}
    time: {start: {from: exact}, begin: 0.03, end: 0.04}
  springs:
    contact: {interface: {method: penalty, coefficients: {normal: 1e9, tangential: 1e7}, iterate: {geometry: fixed_point}}}
    time: {end: 0.012}
)";

/// A roller that is pressed into a block, turned and drawn along it, rubbing.
inline const std::string rolled_block = R"(title: a roller on a block
mesh:
  generate:
    - {name: block, rectangle: {from: [-1, -1], to: [1, 0]}, divisions: [16, 4],
       sides: {top: top, bottom: ground}, points: {right_top: corner}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
functions: {press: {times: [0, 0.1], values: [0, 1]}, draw: {times: [0.1, 0.3], values: [0, 1]}}
supports: [{on: ground, fix: [x, y]}]
contact:
  roller:
    obstacle:
      cylinder: {point: [0, 1], radius: 1}
      move: {x: {value: 0.3, function: draw}, y: {value: -0.05, function: press}}
      rotate: {about: [0, 1], angle: {value: -0.5, function: draw}}
    slave: top
    integration: nodes
    friction: 0.4
time: {scheme: hht, alpha: -0.1, step: 5e-3, end: 0.15}
probes: {corner: {node: corner}}
fields: {formats: [vtu, med], every: 7, last: false}
)";

/// A block that is pressed into a wider one and drawn along it: both flow, by finite strains.
inline const std::string flowing_blocks = R"(title: blocks that flow
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [3, 3], sides: {top: top, bottom: under}}
    - {name: plane, rectangle: {from: [-0.5, -1], to: [1.5, 0]}, divisions: [5, 3], sides: {top: over, bottom: ground}}
physics: plane_strain
materials:
  metal: {law: plastic, young: 1000, poisson: 0.3, density: 0.1, strain: logarithmic, hardening: {linear: {yield_stress: 10, modulus: 50}}}
functions: {press: {times: [0, 0.5, 1], values: [0, 1, 0.9]}, draw: {times: [0, 0.4, 1], values: [0, 0, 1]}}
supports:
  - {on: ground, fix: [x, y]}
  - {on: top, x: {value: 0.05, function: draw}, y: {value: -0.08, function: press}}
contact: {foot: {master: over, slave: under, integration: nodes, friction: 0.2}}
time: {scheme: static, step: 0.1, end: 0.6}
probes:
  most: {on: all, take: max, field: cumulated_plastic_strain, place: gauss_points}
  cut: {section: {point: [0, 0.5], normal: [0, 1], cells: block}}
fields: {formats: [vtu, med], also: [plastic_strain, stress_elga], every: 2, last: false}
)";

/// A rubber block that falls on a table, rubs, turns and bounces off, by forces that keep its energy. Modes
/// of the table's cells are those of the steps that led to them.
inline const std::string bouncing_blocks = R"(title: a block that bounces
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0.1], to: [1, 1.1]}, divisions: [2, 2], cells: quad4, sides: {bottom: under}}
    - {name: table, rectangle: {from: [-1, -1], to: [3, 0]}, divisions: [6, 2], cells: quad4, sides: {top: over, bottom: ground}}
physics: plane_strain
materials:
  rubber: {law: hyperelastic, c10: 50, c01: 10, bulk: 1000, density: 1, cells: block}
  steel: {young: 300, poisson: 0.3, density: 1, strain: green_lagrange, formulation: enhanced, cells: table}
supports: [{on: ground, fix: [x, y]}]
initial: [{on: block, velocity: {x: 2, y: -4}}]
contact: {foot: {master: over, slave: under, friction: 0.2}}
time: {scheme: energy_momentum, step: 0.02, end: 0.3}
probes: {fall: {on: block, take: min, field: velocity}}
fields: {formats: [vtu], every: 3, last: false}
)";

/// A block that swings onto a table, on a connector that rotates.
inline const std::string swinging_block = R"(title: a block that swings onto a table
mesh:
  generate:
    - {name: bob, rectangle: {from: [0.9, -0.1], to: [1.1, 0.1]}, divisions: [2, 2], cells: quad4, sides: {bottom: under}}
    - {name: table, rectangle: {from: [-0.6, -1.4], to: [0.9, -1.05]}, divisions: [9, 2], cells: quad4, sides: {top: over, bottom: ground}}
physics: plane_strain
materials: {any: {young: 1e6, poisson: 0.3, density: 1000, strain: green_lagrange}}
relations: {eye: {embedded: {at: [1, 0], in: bob}}}
connectors: [{on: eye, anchor: [0, 0], rotates: true, force: {elongations: [-1, 0, 1], forces: [-5e3, 0, 1e4]}, damping: 50}]
supports: [{on: ground, fix: [x, y]}]
loads: [{gravity: {y: -9.81, on: bob}}]
contact: {foot: {master: over, slave: under, method: penalty, integration: nodes, friction: 0.2}}
time: {scheme: newmark, step: 5e-3, end: 0.6}
probes: {eye: {on: eye}}
fields: {formats: [vtu], every: 50, last: false}
)";

/// The same beams by central differences.
inline const std::string explicit_beams = [] {
  auto deck = rubbing_beams.substr(0, rubbing_beams.find("time:"));
  deck.insert(deck.find("    friction:"), "    method: penalty\n");
  return deck + R"(time: {scheme: central_difference, end: 6e-3, record: 1e-4}
probes:
  tip: {node: Force}
fields: {formats: [vtu], every: 9}
checkpoint: {every: 4}
)";
}();

} // namespace rubato::test
