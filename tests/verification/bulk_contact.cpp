// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies of large strain that are pressed and hit.
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

#include "verification/bulk_benchmarks.hpp"
#include "verification/bulk_run.hpp"
#include "verification/bulk_turns.hpp"
#include "verification/quarter_disc.hpp"
#include "verification/taylor_bar.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {
namespace {

using mesh::NodeIndex;

constexpr std::string_view prototype = "prototype of this formulation, two meshes within 1 %";
constexpr double percent = 0.01;

/// A quarter of Taylor and Becker's billet (CMAME 39 (1983) 251–277): dies that it sticks to press it by 60
/// %, and its side rolls onto them.
const std::string billet_deck = R"(mesh:
  generate: [{name: billet, rectangle: {from: [0, 0], to: [10, 15]}, divisions: [12, 18], cells: quad4,
    sides: {left: axis, bottom: middle, right: side, top: top}, points: {right_bottom: waist}}]
  groups: {skin: {union: [side, top]}}
physics: axisymmetric
materials: {metal: {law: plastic, young: 200e3, poisson: 0.3, strain: logarithmic,
  hardening: {linear: {yield_stress: 700, modulus: 300}}}}
functions: {down: {ramp: [0, 1]}}
supports: [{on: axis, fix: x}, {on: middle, fix: y}]
contact: {die: {slave: skin, friction: 10,
  obstacle: {plane: {point: [0, 15], normal: [0, -1]}, move: {y: {value: -9, function: down}}}}}
newton: {tangent: full}
time: {scheme: static, step: 0.0166666666666666667, end: 1}
probes: {waist: {node: waist}, hold: {on: middle, field: reaction}}
)";

Benchmark billet() {
  constexpr std::array forces{261.0, 306.0, 362.0, 438.0, 551.0, 772.0};
  constexpr std::array radii{10.82, 11.65, 12.55, 13.59, 14.88, 16.53};
  Benchmark out{
      23,
      "a billet 10 × 30 between dies that it sticks to, σ_y = 700, H = 300; 12 × 18 QUAD4 a quarter",
      {},
      {}};
  BulkRun run(billet_deck);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    run.go_to(static_cast<double>(i + 1) / 6);
    const auto at = fmt::format(" at {} %", 10 * (i + 1));
    out.numbers.push_back(
        {"force" + at + " [kN]", run.probe("hold.y") / 1e3, forces[i], percent, std::string(prototype)});
    out.numbers.push_back(
        {"radius in the middle" + at, 10 + run.probe("waist.x"), radii[i], percent, std::string(prototype)});
  }
  // In [0, 4].
  out.numbers.push_back({"deepest cut, halvings of the step", static_cast<double>(run.walk().deepest_cut), 2,
                         1, "no step below a sixteenth: 2, and as much off it at most"});
  out.residuals = run.hardest_step();
  return out;
}

/// A quarter of a cylinder of radius 1 in plane strain, whose plate comes down on `skin`.
mesh::Mesh cylinder_mesh(int n) {
  const auto disc = quarter_disc(1, n);
  mesh::MeshBuilder builder(2);
  const auto is_on_circle = [&](NodeIndex node) {
    return std::abs(disc.points[static_cast<std::size_t>(node)].norm() - 1) < 1e-9;
  };
  for (const auto& x : disc.points) {
    const std::array node{builder.add_node(x)};
    if (std::abs(x[0]) < 1e-12)
      builder.add_to_node_group("middle", node);
    if (std::abs(x[1]) < 1e-12)
      builder.add_to_node_group("ground", node);
  }
  for (const auto& cell : disc.cells)
    builder.add_cell(CellType::quad4, cell);
  for (const auto& cell : disc.cells)
    for (std::size_t i = 0; i < cell.size(); ++i) {
      const std::array edge{cell[i], cell[(i + 1) % cell.size()]};
      if (std::ranges::all_of(edge, is_on_circle)) {
        const std::array face{builder.add_cell(CellType::seg2, edge)};
        builder.add_to_cell_group("skin", face);
      }
    }
  return std::move(builder).build();
}

const std::string cylinder_deck = R"(mesh: {file: quarter.med}
physics: plane_strain
materials: {rubber: {law: hyperelastic, c10: 0.5, bulk: 200}}
functions: {down: {ramp: [0, 1]}}
supports: [{on: middle, fix: x}, {on: ground, fix: y}]
contact: {plate: {slave: skin,
  obstacle: {plane: {point: [0, 1], normal: [0, -1]}, move: {y: {value: -0.3, function: down}}}}}
newton: {tangent: full}
time: {scheme: static, step: 0.0833333333333333333, end: 1}
probes: {hold: {on: ground, field: reaction}}
)";

Benchmark rubber_cylinder() {
  constexpr std::array forces{0.0212, 0.0530, 0.0953, 0.1505, 0.2230, 0.3192};
  constexpr double young = 9 * 200.0 / (3 * 200 + 1), diameter = 2;
  Benchmark out{24,
                "a rubber cylinder between smooth plates, plane strain, K/μ = 200; 16 QUAD4 along a quarter",
                {},
                {}};
  BulkRun run(cylinder_deck, cylinder_mesh(8));
  for (std::size_t i = 0; i < forces.size(); ++i) {
    run.go_to(static_cast<double>(i + 1) / 6);
    const double force = 2 * run.probe("hold.y") / (young * diameter);
    const auto quantity = fmt::format("F/(E D L) squeezed by {} %", 5 * (i + 1));
    if (i == 0)
      out.numbers.push_back({quantity, force, 0.0210, percent, "Hertz, line contact"});
    out.numbers.push_back({quantity, force, forces[i], percent, std::string(prototype)});
  }
  out.residuals = run.hardest_step();
  return out;
}

/// What published codes have lies between these two.
BenchmarkNumber between(std::string quantity, double found, double low, double high) {
  const double middle = 0.5 * (low + high);
  return {std::move(quantity), found, middle, (high - low) / 2 / middle, "range of published codes"};
}

Benchmark taylor() {
  Benchmark out{
      26,
      "Taylor's bar, 3.2 × 32.4 mm at 227 m/s, 80 µs; its foot stays in the plane of the wall, as published "
      "studies have it: on an obstacle that only pushes the foot's edge lifts off, and is 0.4 mm wider",
      {},
      {}};
  for (const auto mesh : {TaylorMesh::meridian, TaylorMesh::quarter}) {
    const auto result = run(taylor_bar(mesh, TaylorWall::sliding));
    const std::string cells = mesh == TaylorMesh::meridian ? ", 4 × 25 QUAD4" : ", a quarter of 300 HEXA8";
    out.numbers.push_back(between("length [mm]" + cells, 1e3 * result.length, 21.4, 21.8));
    out.numbers.push_back(between("radius [mm]" + cells, 1e3 * result.radius, 6.9, 7.2));
  }
  return out;
}

} // namespace

std::vector<Benchmark> contact_benchmarks() {
  return {billet(), rubber_cylinder(), taylor(), rigid_turns()};
}

} // namespace rubato::verification
