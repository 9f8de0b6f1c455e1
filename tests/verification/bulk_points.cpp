// SPDX-License-Identifier: LGPL-3.0-or-later
// Single cells and small blocks in uniform states, which have closed forms.
#include "rubato/core/transformed.hpp"

#include <fmt/format.h>

#include "verification/bulk_benchmarks.hpp"
#include "verification/bulk_run.hpp"
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {
namespace {

constexpr double closed = 1e-10; ///< closed forms that steps do not approximate
constexpr double approximate = 0.01;
constexpr std::string_view steel = "young: 200e3, poisson: 0.3";
constexpr std::string_view form = "closed form";

/// Where a function that grows becomes 0.
double root(const std::function<double(double)>& function, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (function(middle) > 0 ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

/// A stress that is E (ε − p) and R(p).
double uniaxial_stress(double young, double strain, const std::function<double(double)>& hardening) {
  const double p = root([&](double x) { return hardening(x) - young * (strain - x); }, 0, strain);
  return young * (strain - p);
}

/// A cube of side 1, one HEXA8, that slides on three of its sides; a fourth is moved by `pull` times the
/// function `course`. `more` are further supports.
std::string pulled_cube(std::string_view material, double pull, std::string_view course, double step,
                        double end, std::string_view more = "") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: cube, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [1, 1, 1],
  sides: {{left: left, right: right, bottom: bottom, top: top, back: back}}, points: {{right_top_front: corner}}}}]}}
physics: solid
materials: {{any: {{{}}}}}
functions: {{course: {}}}
supports: [{{on: left, fix: x}}, {{on: bottom, fix: y}}, {{on: back, fix: z}},
  {{on: right, x: {{value: {}, function: course}}}}{}]
newton: {{residual: 1.0e-13, tangent: full}}
time: {{scheme: static, step: {:.17g}, end: {}}}
probes:
  force: {{on: right, field: reaction}}
  corner: {{node: corner}}
  stress: {{on: all, take: max, field: stress, place: gauss_points}}
)",
      material, course, pull, more, step, end);
}

constexpr std::string_view ramp = "{ramp: [0, 1]}";

/// All nodes of the hull of 2 × 2 × 2 HEXA8 have the displacement `x` along x, so that the node inside is
/// free.
std::string sheared_block(std::string_view material, std::string_view x, double step, double end) {
  return fmt::format(R"(mesh:
  generate: [{{name: block, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [2, 2, 2]}}]
  groups: {{skin: {{skin: all}}, hull: {{nodes_of: skin}}}}
physics: solid
materials: {{any: {{{}}}}}
supports: [{{on: hull, fix: [y, z], x: "{}"}}]
newton: {{residual: 1.0e-13, tangent: full}}
time: {{scheme: static, step: {:.17g}, end: {}}}
probes:
  most: {{on: all, take: max, field: stress, place: gauss_points}}
  least: {{on: all, take: min, field: stress, place: gauss_points}}
)",
                     material, x, step, end);
}

std::string plastic(std::string_view hardening, std::string_view more = "") {
  return fmt::format("law: plastic, {}, hardening: {{{}}}{}", steel, hardening, more);
}

BenchmarkNumber number(std::string quantity, double found, double expected, double tolerance,
                       std::string_view source = form) {
  return {std::move(quantity), found, expected, tolerance, std::string(source)};
}

Benchmark prager() {
  BulkRun run(pulled_cube(plastic("linear: {yield_stress: 200}", ", kinematic: {modulus: 20e3}"), 0.01,
                          "{times: [0, 1, 2], values: [0, 1, -1]}", 0.1, 2));
  const double tangent = 200e3 * 20e3 / 220e3, stress = 200 + (0.01 - 0.001) * tangent;
  Benchmark out{6, "pulled and pressed by 1 %, E = 200e3, σ_y = 200, Prager C = 20e3; HEXA8", {}, {}};
  run.go_to(1);
  out.numbers.push_back(number("stress at +1 %", run.probe("force.x"), stress, closed));
  out.numbers.push_back(number("the same at a Gauss point", run.probe("stress.xx"), stress, closed));
  run.to_end();
  out.numbers.push_back(number("stress at -1 %", run.probe("force.x"), -stress, closed));
  out.residuals = run.hardest_step();
  return out;
}

Benchmark armstrong_frederick() {
  const auto material = plastic("linear: {yield_stress: 200}", ", kinematic: {modulus: 20e3, recall: 100}");
  const double exact =
      uniaxial_stress(200e3, 0.02, [](double p) { return 200 + 20e3 / 100 * (1 - std::exp(-100 * p)); });
  const auto stress = [&](int steps) {
    BulkRun run(pulled_cube(material, 0.02, ramp, 1.0 / steps, 1));
    run.to_end();
    return run.probe("force.x");
  };
  const double coarse = stress(100), fine = stress(1000);
  Benchmark out{7, "pulled by 2 %, σ_y = 200, Armstrong and Frederick, C = 20e3, γ = 100; HEXA8", {}, {}};
  out.numbers.push_back(number("stress, 1000 steps", fine, exact, approximate));
  out.numbers.push_back(number("order in the step, 100 to 1000 steps",
                               std::log10((exact - coarse) / (exact - fine)), 1, approximate, "theory"));
  return out;
}

Benchmark isotropic_hardening() {
  Benchmark out{
      8, "pulled, hardening by Voce 200, 100, 50, H = 500 to 5 %, by a table to 2.5 %; HEXA8", {}, {}};
  BulkRun voce(pulled_cube(plastic("voce: {yield_stress: 200, saturation: 100, exponent: 50, modulus: 500}"),
                           0.05, ramp, 1, 1));
  voce.to_end();
  const double exact =
      uniaxial_stress(200e3, 0.05, [](double p) { return 200 + 100 * (1 - std::exp(-50 * p)) + 500 * p; });
  out.numbers.push_back(number("stress, Voce, one step", voce.probe("force.x"), exact, closed));
  out.residuals = voce.hardest_step();
  BulkRun table(pulled_cube(plastic("table: [[0, 200], [0.01, 260], [0.03, 300]]"), 0.025, ramp, 0.2, 1));
  table.to_end();
  const double slope = 40 / 0.02;
  out.numbers.push_back(number("stress, table", table.probe("force.x"),
                               (260 + slope * (0.025 - 0.01)) / (1 + slope / 200e3), closed));
  return out;
}

double sheet_stress(bool both_ways) {
  BulkRun run(fmt::format(
      R"(mesh: {{generate: [{{name: sheet, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [1, 1],
  sides: {{left: left, right: right, bottom: bottom, top: top}}}}]}}
physics: plane_stress
materials: {{any: {{{}}}}}
functions: {{course: {{ramp: [0, 1]}}}}
supports: [{{on: left, fix: x}}, {{on: bottom, fix: y}}, {{on: right, x: {{value: 0.02, function: course}}}}{}]
newton: {{residual: 1.0e-13}}
time: {{scheme: static, step: 1, end: 1}}
probes: {{force: {{on: right, field: reaction}}}}
)",
      plastic("linear: {yield_stress: 200, modulus: 2000}"),
      both_ways ? ", {on: top, y: {value: 0.02, function: course}}" : ""));
  run.to_end();
  return run.probe("force.x");
}

Benchmark plane_stress() {
  // In two directions: 2 % = (1 − ν) σ/E + p/2.
  const double one_way = (200 + 2000 * 0.02) / (1 + 2000 / 200e3);
  const double both_ways = (200 + 2 * 2000 * 0.02) / (1 + 2 * 2000 * 0.7 / 200e3);
  return {9,
          "a sheet in plane stress pulled by 2 % in one step, σ_y = 200, H = 2000; QUAD4",
          {number("stress, pulled one way", sheet_stress(false), one_way, closed),
           number("stress, pulled both ways", sheet_stress(true), both_ways, closed)},
          {}};
}

/// Tractions of σ_xx and σ_xy on a free cube; pseudo-time 1 is the first state, 2 the second.
std::string tension_and_shear(int steps) {
  return fmt::format(
      R"(mesh: {{generate: [{{name: cube, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [1, 1, 1],
  sides: {{left: left, right: right, bottom: bottom, top: top}},
  points: {{left_bottom_back: o, right_bottom_back: x, left_top_back: y}}}}]}}
physics: solid
materials: {{any: {{law: plastic, young: 195e3, poisson: 0.3,
  hardening: {{linear: {{yield_stress: 181, tangent_modulus: 1930}}}}}}}}
functions: {{normal: {{times: [0, 1, 2], values: [0, 151.2, 257.2]}},
  shear: {{times: [0, 1, 2], values: [0, 93.1, 33.1]}}}}
supports: [{{on: o, fix: [x, y, z]}}, {{on: x, fix: [y, z]}}, {{on: y, fix: z}}]
loads:
  - surface_force: {{on: right, x: 1, function: normal}}
  - surface_force: {{on: left, x: -1, function: normal}}
  - surface_force: {{on: right, y: 1, function: shear}}
  - surface_force: {{on: left, y: -1, function: shear}}
  - surface_force: {{on: top, x: 1, function: shear}}
  - surface_force: {{on: bottom, x: -1, function: shear}}
newton: {{residual: 1.0e-12}}
time: {{scheme: static, step: {:.17g}, end: 2}}
probes:
  strain: {{on: all, take: mean, field: strain, place: gauss_points}}
  p: {{on: all, take: max, field: cumulated_plastic_strain, place: gauss_points}}
)",
      1.0 / steps);
}

Benchmark shear_after_tension() {
  constexpr double young = 195e3, slope = 1930, modulus = young * slope / (young - slope);
  const auto p = [](double normal, double shear) {
    return (std::sqrt(normal * normal + 3 * shear * shear) - 181) / modulus;
  };
  constexpr double normal = 151.2, shear = 93.1;
  const double first = p(normal, shear), mises = 181 + modulus * first;
  constexpr std::string_view aster = "Code_Aster, SSNP15";
  BulkRun run(tension_and_shear(400));
  Benchmark out{
      10, "tension and shear to (151.2, 93.1), then to (257.2, 33.1), 400 steps each; HEXA8", {}, {}};
  run.go_to(1);
  out.numbers.push_back(number("ε_xx at the first state", run.probe("strain.xx"),
                               normal / young + first * normal / mises, closed));
  out.numbers.push_back(number("ε_xy at the first state", run.probe("strain.xy"),
                               1.3 * shear / young + 1.5 * first * shear / mises, closed));
  out.numbers.push_back(number("p at the first state", run.probe("p"), first, closed));
  run.to_end();
  out.numbers.push_back(
      number("ε_xx at the second state", run.probe("strain.xx"), 0.035265, approximate, aster));
  out.numbers.push_back(
      number("ε_xy at the second state", run.probe("strain.xy"), 0.020471, approximate, aster));
  out.numbers.push_back(number("p at the second state", run.probe("p"), p(257.2, 33.1), closed));
  return out;
}

Benchmark hencky_tension() {
  BulkRun run(pulled_cube(plastic("linear: {yield_stress: 200, modulus: 1000}", ", strain: logarithmic"), 0.5,
                          ramp, 0.1, 1));
  run.to_end();
  const double stretch = 1.5, stress = (200 + 1000 * std::log(stretch)) / (1 + 1000 / 200e3);
  const double volume = stretch * (1 + run.probe("corner.y")) * (1 + run.probe("corner.z"));
  return {11,
          "pulled to λ = 1.5, logarithmic strain, σ_y = 200, H = 1000; HEXA8",
          {number("Kirchhoff stress, P λ", run.probe("force.x") * stretch, stress, closed),
           number("J", volume, std::exp(0.4 * stress / 200e3), closed)},
          run.hardest_step()};
}

Benchmark hencky_shear() {
  Benchmark out{12, "simple shear, elastic, logarithmic strain, μ = 1; 8 HEXA8", {}, {}};
  BulkRun run(sheared_block("young: 2.6, poisson: 0.3, strain: logarithmic", "2*y*t", 0.1, 2));
  for (const double shear : {2.0, 4.0}) {
    run.go_to(shear / 2);
    const double stress = 4 * std::asinh(shear / 2) / std::sqrt(4 + shear * shear);
    out.numbers.push_back(
        number(fmt::format("τ_12/μ at γ = {}, most", shear), run.probe("most.xy"), stress, closed));
    out.numbers.push_back(
        number(fmt::format("τ_12/μ at γ = {}, least", shear), run.probe("least.xy"), stress, closed));
    out.numbers.push_back(
        number(fmt::format("τ_11/μ at γ = {}", shear), run.probe("most.xx"), stress * shear / 2, closed));
  }
  out.residuals = run.hardest_step();
  return out;
}

Benchmark rubber() {
  constexpr std::string_view source = "closed form, incompressible";
  constexpr double nearly = 1e-4; ///< K/μ is 1e5
  const auto stress = [](std::string_view numbers, std::string_view more) {
    BulkRun run(pulled_cube(fmt::format("law: hyperelastic, {}, bulk: 1e5", numbers), 1, ramp, 0.1, 1, more));
    run.to_end();
    return run.probe("force.x");
  };
  return {
      13,
      "rubber pulled to λ = 2, μ = 1, K/μ = 1e5; HEXA8",
      {number("P, neo-Hookean, one way", stress("c10: 0.5", ""), 2 - 1.0 / 4, nearly, source),
       number("P, neo-Hookean, both ways", stress("c10: 0.5", ", {on: top, y: {value: 1, function: course}}"),
              2 - 1.0 / 32, nearly, source),
       number("P, Mooney and Rivlin, 0.4 and 0.1", stress("c10: 0.4, c01: 0.1", ""),
              2 * (0.4 + 0.1 / 2) * (2 - 1.0 / 4), nearly, source)},
      {}};
}

Benchmark green_lagrange() {
  BulkRun run(pulled_cube("young: 1, poisson: 0.3, strain: green_lagrange", 0.5, ramp, 0.2, 1));
  run.to_end();
  return {14,
          "pulled to λ = 1.5, Green-Lagrange strain; HEXA8",
          {number("P/E", run.probe("force.x"), 1.5 * (1.5 * 1.5 - 1) / 2, closed)},
          run.hardest_step()};
}

Benchmark prony() {
  const auto part = [](double shear, double time) { return 0.02 * shear * time * (1 - std::exp(-1 / time)); };
  const double exact = 0.02 + part(2, 0.1) + part(3, 1);
  Benchmark out{
      17, "shear that grows to γ = 0.02 in 1, Prony, G = 1 + 2 + 3, τ = 0.1 and 1; 8 HEXA8", {}, {}};
  for (const int steps : {1, 7, 100}) {
    BulkRun run(sheared_block(
        "law: prony, young: 2.6, poisson: 0.3, terms: [{shear: 2, time: 0.1}, {shear: 3, time: 1}]",
        "0.02*y*t", 1.0 / steps, 1));
    run.to_end();
    out.numbers.push_back(number(fmt::format("τ_12, {} steps", steps), run.probe("most.xy"), exact, closed));
  }
  return out;
}

Benchmark orthotropic() {
  Benchmark out{18, "a sheet of E = 150 and 10, ν = 0.3, G = 5 with its axes turned, pulled; QUAD4", {}, {}};
  for (const int degrees : {30, 45}) {
    BulkRun run(fmt::format(
        R"(mesh: {{generate: [{{name: sheet, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [1, 1],
  sides: {{left: left, right: right}}, points: {{left_bottom: o, left_top: y}}}}]}}
physics: plane_stress
materials: {{any: {{law: orthotropic, young_x: 150, young_y: 10, poisson_xy: 0.3, shear_xy: 5, angle_z: {}}}}}
supports: [{{on: o, fix: [x, y]}}, {{on: y, fix: x}}]
loads: [{{surface_force: {{on: right, x: 1}}}}, {{surface_force: {{on: left, x: -1}}}}]
time: {{scheme: static, step: 1, end: 1}}
probes: {{strain: {{on: all, take: mean, field: strain, place: gauss_points}}}}
)",
        degrees));
    run.to_end();
    const double c = std::cos(degrees * std::numbers::pi / 180),
                 s = std::sin(degrees * std::numbers::pi / 180);
    const double compliance =
        std::pow(c, 4) / 150 + std::pow(s, 4) / 10 + c * c * s * s * (1.0 / 5 - 2 * 0.3 / 150);
    out.numbers.push_back(
        number(fmt::format("E_x at {}°", degrees), 1 / run.probe("strain.xx"), 1 / compliance, closed));
  }
  return out;
}

double held_cube_stress() {
  BulkRun run(R"(mesh:
  generate: [{name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2]}]
  groups: {skin: {skin: all}, hull: {nodes_of: skin}}
physics: solid
materials: {any: {young: 2e5, poisson: 0.3, expansion: 1.2e-5}}
temperature: [{on: all, value: 100}]
supports: [{on: hull, fix: [x, y, z]}]
time: {scheme: static, step: 1, end: 1}
probes: {stress: {on: all, take: mean, field: stress, place: gauss_points}}
)");
  run.to_end();
  return run.probe("stress.xx");
}

double hot_tube_widening(std::string_view cells) {
  BulkRun run(fmt::format(
      R"deck(mesh: {{generate: [{{name: tube, rectangle: {{from: [20, 0], to: [40, 2]}}, divisions: [32, 1], cells: {},
  sides: {{left: inner, bottom: bottom, top: top}}}}]}}
physics: axisymmetric
materials: {{any: {{young: 2e5, poisson: 0.3, expansion: 1.2e-5}}}}
temperature: [{{on: all, value: "100*log(40/x)/log(2)"}}]
supports: [{{on: bottom, fix: y}}, {{on: top, fix: y}}]
time: {{scheme: static, step: 1, end: 1}}
probes: {{inner: {{on: inner, take: mean}}}}
)deck",
      cells));
  run.to_end();
  return run.probe("inner.x");
}

Benchmark thermal() {
  // ∫ r ln(b/r) dr from a to b
  const double integral = 400 - 200 * std::numbers::ln2 - 100;
  const double widening = 2 * 1.3 * 1.2e-5 * 20 * (100 / std::numbers::ln2 * integral) / (40 * 40 - 20 * 20);
  constexpr std::string_view book = "Timoshenko, Goodier, Theory of Elasticity";
  return {
      19,
      "a held cube with αΔT = 1.2e-3, E = 2e5; a tube 20 to 40 between planes with 100 ln(b/r)/ln(b/a), α = "
      "1.2e-5, 32 cells",
      {number("stress of the cube", held_cube_stress(), -2e5 * 1.2e-3 / 0.4, closed),
       number("u(a), QUAD4", hot_tube_widening("quad4"), widening, approximate, book),
       number("u(a), QUAD8", hot_tube_widening("quad8"), widening, approximate, book)},
      {}};
}

} // namespace

std::vector<Benchmark> point_benchmarks() {
  constexpr std::array all{prager,
                           armstrong_frederick,
                           isotropic_hardening,
                           plane_stress,
                           shear_after_tension,
                           hencky_tension,
                           hencky_shear,
                           rubber,
                           green_lagrange,
                           prony,
                           orthotropic,
                           thermal};
  return transformed<Benchmark>(all, [](const auto make) { return make(); });
}

} // namespace rubato::verification
