// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/bulk_structures.hpp"

#include <fmt/format.h>

#include "verification/bulk_decks.hpp"
#include "verification/bulk_run.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace rubato::verification {
namespace {

using Eigen::Vector3d;

constexpr double percent = 1e-2;
const std::string prototype = "independent prototype of the same formulation";

/// At the end of a deck: each iteration has a tangent of its own.
const std::string full_tangent = "newton: {tangent: full}\n";

/// Within 1 %, as all numbers with nothing else said.
BenchmarkNumber number(std::string quantity, double found, double expected, std::string source,
                       double tolerance = percent) {
  return {std::move(quantity), found, expected, tolerance, std::move(source)};
}

Benchmark benchmark_of(int row, std::string what, std::vector<BenchmarkNumber> numbers = {}) {
  return {row, std::move(what), std::move(numbers), {}};
}

// --- Cook's membrane

BenchmarkNumber incompressible_corner(int n) {
  BulkRun run(cook_deck(n, "plane_strain", "young: 250, poisson: 0.4999, formulation: mean_dilatation", 100),
              cook_shape);
  run.to_end();
  return number(fmt::format("{0} × {0}: corner displacement", n), run.probe("corner.y"), 7.77,
                "converged, three formulations");
}

Benchmark incompressible_membrane(int n) {
  return benchmark_of(1, "Cook's membrane, plane strain, ν = 0.4999, `mean_dilatation`",
                      {incompressible_corner(n)});
}

/// What is expected of the corner on one mesh.
struct RubberCorner {
  int n = 0;
  double expected = 0;
};

Benchmark rubber_membrane(std::string_view formulation, const std::vector<RubberCorner>& meshes,
                          std::string what) {
  auto benchmark = benchmark_of(16, std::move(what));
  for (const auto& [n, expected] : meshes) {
    const auto material = fmt::format("law: hyperelastic, c10: 40.0969, bulk: 400889.8{}", formulation);
    BulkRun run(cook_deck(n, "plane_strain", material, 100, 0.05) + full_tangent, cook_shape);
    run.to_end();
    const auto quantity = fmt::format("{0} × {0}: corner displacement", n);
    benchmark.numbers.push_back(number(quantity, run.probe("corner.y"), expected, prototype));
    if (n >= 32 && formulation.empty())
      benchmark.numbers.push_back(
          number(quantity, run.probe("corner.y"), 6.93, "the same, converged to ± 0.02"));
    benchmark.residuals = run.hardest_step();
  }
  return benchmark;
} // namespace

Benchmark rubber_membrane(const std::vector<RubberCorner>& meshes) {
  return rubber_membrane("", meshes, "Cook's membrane of neo-Hookean rubber, K/μ = 5000, finite strain");
}

// --- tubes

Benchmark lame_tube(int cells) {
  const Tube tube{.inner = 20, .outer = 40, .cells = cells};
  BulkRun run(tube_deck(tube, "young: 10, poisson: 0.4999, formulation: mean_dilatation", "", tube_pressure));
  run.to_end();
  return benchmark_of(2, "tube 20 to 40 under inner pressure, ν = 0.4999, `mean_dilatation`",
                      {number(fmt::format("{} cells: widening of the inner radius", cells),
                              run.probe("inner.x"), lame_widening(tube, 10, 0.4999), "Lamé")});
}

constexpr double yield_stress = 0.24, young = 210;
constexpr Tube yielding_tube{.inner = 100, .outer = 200, .cells = 32};

/// Of R. Hill, The Mathematical Theory of Plasticity (1950), plane strain, elastic and ideally plastic.
struct Hill {
  double border = 0; ///< radius up to which the tube yields
  double outer = 0;  ///< widening of the outer radius
};

/// Of plane strain: 2/√3 of that in tension.
double hill_yield_stress() {
  return 2 / std::numbers::sqrt3 * yield_stress;
}

double hill_pressure(double border) {
  const double a = yielding_tube.inner, b = yielding_tube.outer;
  return hill_yield_stress() * (std::log(border / a) + 0.5 * (1 - border * border / (b * b)));
}

double hill_limit() {
  return hill_pressure(yielding_tube.outer);
}

Hill hill_at(double pressure, double poisson) {
  double low = yielding_tube.inner, high = yielding_tube.outer;
  while (high - low > 1e-12 * high) {
    const double middle = 0.5 * (low + high);
    (hill_pressure(middle) < pressure ? low : high) = middle;
  }
  return {low, hill_yield_stress() * low * low * (1 - poisson * poisson) / (young * yielding_tube.outer)};
}

std::string ideally_plastic(double poisson) {
  return fmt::format("law: plastic, young: {}, poisson: {}, hardening: {{linear: {{yield_stress: {}}}}}",
                     young, poisson, yield_stress);
}

/// The outer border of the outermost cell that yields.
double border_of(const BulkRun& run) {
  const auto p = run.cell_values("cumulated_plastic_strain_elga");
  const auto last = std::find_if(p.rbegin(), p.rend(), [](double value) { return value > 0; });
  const auto points = p.size() / static_cast<std::size_t>(yielding_tube.cells);
  const auto cells = (static_cast<std::size_t>(p.rend() - last) + points - 1) / points;
  return yielding_tube.inner + yielding_tube.height() * static_cast<double>(cells);
}

constexpr std::string_view yielding_pressure = R"(
functions: {pressure: {times: [0, 0.18], values: [0, 0.18]}}
loads: [{pressure: {on: inner, value: 1, function: pressure}}]
time: {scheme: static, step: 0.01, end: 0.18}
)";

double limit_pressure(double poisson) {
  BulkRun run(tube_deck(yielding_tube, ideally_plastic(poisson),
                        "{on: inner, x: {value: 1, function: grows}}",
                        "functions: {grows: {ramp: {begin: 0, end: 1}}}\n"
                        "time: {scheme: static, step: 0.05, end: 1}"));
  run.to_end();
  return run.probe("hold.x") / (2 * std::numbers::pi * yielding_tube.inner * yielding_tube.height());
}

Benchmark hill_tube(double poisson) {
  BulkRun run(tube_deck(yielding_tube, ideally_plastic(poisson), "", yielding_pressure) + full_tangent);
  const bool keeps_volume = poisson > 0.49;
  auto benchmark = benchmark_of(
      keeps_volume ? 4 : 5, fmt::format("tube 100 to 200, ideally plastic, plane strain, ν = {}", poisson));
  const std::string hill = keeps_volume ? "Hill 1950" : "Hill 1950 (exact for ν = 0.5)";
  const std::array<double, 2> prototype_inner{0.13978, 0.26294}, prototype_outer{0.08725, 0.15393};
  for (const std::size_t i : {0U, 1U}) {
    const double pressure = i == 0 ? 0.14 : 0.18;
    run.go_to(pressure);
    const auto exact = hill_at(pressure, poisson);
    const auto at = fmt::format("p = {}: ", pressure);
    auto& numbers = benchmark.numbers;
    numbers.push_back(number(at + "widening of the outer radius", run.probe("outer.x"), exact.outer, hill));
    if (keeps_volume) {
      numbers.push_back(number(at + "radius up to which it yields, ± one cell", border_of(run), exact.border,
                               hill, yielding_tube.height() / exact.border));
      continue;
    }
    numbers.push_back(
        number(at + "widening of the outer radius", run.probe("outer.x"), prototype_outer[i], prototype));
    numbers.push_back(
        number(at + "widening of the inner radius", run.probe("inner.x"), prototype_inner[i], prototype));
  }
  benchmark.numbers.push_back(number("limit pressure", limit_pressure(poisson), hill_limit(), "Hill 1950"));
  if (!keeps_volume) // there K u of the cells is 3000 times their forces, and residuals end at its rounding
    benchmark.residuals = run.hardest_step();
  return benchmark;
}

constexpr double shear = 1;

/// Of a tube of incompressible neo-Hookean rubber in plane strain: ∫ μ (r²/R² − R²/r²) R/r² dR with r² = R² +
/// r_a² − a², by Simpson's rule.
double rubber_pressure(const Tube& tube, double widening) {
  constexpr int parts = 2000;
  const double inner = tube.inner + widening, growth = inner * inner - tube.inner * tube.inner;
  const double h = (tube.outer - tube.inner) / parts;
  double sum = 0;
  for (int i = 0; i <= parts; ++i) {
    const double whole = tube.inner + i * h, now = whole * whole + growth;
    const double stretch = now / (whole * whole);
    sum += (i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2) * (stretch - 1 / stretch) * whole / now;
  }
  return shear * sum * h / 3;
}

BulkRun rubber_tube_run(const Tube& tube, std::string_view formulation) {
  const auto material = fmt::format("law: hyperelastic, c10: {}, bulk: 1e4{}", 0.5 * shear, formulation);
  return BulkRun(tube_deck(tube, material, "{on: inner, x: {value: 1, function: grows}}",
                           "functions: {grows: {ramp: {begin: 0, end: 1}}}\n"
                           "time: {scheme: static, step: 0.05, end: 1}\n") +
                 full_tangent);
}

/// By the area that the inner side has now.
double inner_pressure(const Tube& tube, const BulkRun& run) {
  return run.probe("hold.x") / (2 * std::numbers::pi * (tube.inner + run.probe("inner.x")) * tube.height());
}

Benchmark rubber_tube(int cells) {
  const Tube tube{.inner = 1, .outer = 2, .cells = cells};
  auto run = rubber_tube_run(tube, "");
  auto benchmark = benchmark_of(15, "tube 1 to 2 of neo-Hookean rubber, μ = 1, K/μ = 1e4, plane strain");
  for (const double widening : {0.25, 0.5, 1.}) {
    run.go_to(widening);
    benchmark.numbers.push_back(number(fmt::format("{} cells, u(a) = {}: inner pressure", cells, widening),
                                       inner_pressure(tube, run), rubber_pressure(tube, widening),
                                       "quadrature, incompressible"));
  }
  benchmark.residuals = run.hardest_step();
  return benchmark;
}

Benchmark locked_rubber_tube() {
  const Tube tube{.inner = 1, .outer = 2, .cells = 8};
  auto run = rubber_tube_run(tube, ", formulation: full");
  run.go_to(0.25);
  return benchmark_of(
      15, "the rubber tube with `full` (exact: 0.27571)",
      {number("8 cells, u(a) = 0.25: inner pressure", inner_pressure(tube, run), 1.60, prototype)});
}

// --- beams

Benchmark elastic_cantilever(std::string_view divisions) {
  BulkRun run(beam_deck(divisions, "hexa8", "young: 1, poisson: 0.3, formulation: enhanced"));
  run.to_end();
  return benchmark_of(3, "cantilever 20 × 2 × 2, ν = 0.3, HEXA8 `enhanced`",
                      {number(fmt::format("{}: deflection × E/F", divisions), run.probe("end.z"), 2000,
                              "Euler; Timoshenko without the clamp 2016")});
}

/// Where the tip of the elastica is under the load k = F L²/EI.
struct ElasticaTip {
  double load = 0, down = 0, back = 0;
};
constexpr std::array<ElasticaTip, 4> elastica_tips{
    {{1, 0.30172, 0.05643}, {2, 0.49346, 0.16064}, {5, 0.71379, 0.38763}, {10, 0.81061, 0.55500}}};

/// E h²/12 = 1 for the height h = 0.01: the load per area is k.
std::string elastica_deck(bool solid, std::string_view divisions, std::string_view formulation) {
  return fmt::format(R"(
mesh: {{generate: [{{name: beam, {}, divisions: {},
  sides: {{left: held, right: pulled}}}}]}}
physics: {}
materials: {{it: {{young: 12e4, poisson: 0, strain: green_lagrange, formulation: {}}}}}
functions: {{load: {{times: [0, 10], values: [0, 10]}}}}
supports: [{{on: held, fix: [x, y{}]}}]
loads: [{{surface_force: {{on: pulled, y: 1, function: load}}}}]
probes: {{end: {{on: pulled, take: mean}}}}
newton: {{tangent: full}}
time: {{scheme: static, step: 0.25, end: 10}}
)",
                     solid ? "box: {from: [0, 0, 0], to: [1, 0.01, 0.01]}"
                           : "rectangle: {from: [0, 0], to: [1, 0.01]}",
                     divisions, solid ? "solid" : "plane_strain", formulation, solid ? ", z" : "");
}

Benchmark elastica(bool solid, std::string_view divisions) {
  BulkRun run(elastica_deck(solid, divisions, "enhanced"));
  auto benchmark = benchmark_of(20, fmt::format("elastica, L/h = 100, {} {} `enhanced`, Green-Lagrange",
                                                solid ? "HEXA8" : "QUAD4", divisions));
  for (const auto& tip : elastica_tips) {
    run.go_to(tip.load);
    const auto at = fmt::format("k = {}: ", tip.load);
    benchmark.numbers.push_back(number(at + "w/L", run.probe("end.y"), tip.down, "Mattiasson 1981"));
    benchmark.numbers.push_back(number(at + "u/L", -run.probe("end.x"), tip.back, "Mattiasson 1981"));
  }
  benchmark.residuals = run.hardest_step();
  return benchmark;
}

Benchmark locked_elastica(bool solid, std::string_view divisions, double at_one, double at_ten) {
  BulkRun run(elastica_deck(solid, divisions, "full"));
  auto benchmark = benchmark_of(20, fmt::format("the elastica with `full` {} {} (exact: 0.30172, 0.81061)",
                                                solid ? "HEXA8" : "QUAD4", divisions));
  for (const auto& [load, expected] : {std::pair(1., at_one), std::pair(10., at_ten)}) {
    run.go_to(load);
    benchmark.numbers.push_back(
        number(fmt::format("k = {}: w/L", load), run.probe("end.y"), expected, prototype));
  }
  return benchmark;
}

/// Its far end is moved by 0.3 across, and free along.
BulkRun plastic_cantilever_run(std::string_view divisions, std::string_view formulation) {
  return BulkRun(fmt::format(R"(
mesh: {{generate: [{{name: beam, rectangle: {{from: [0, 0], to: [10, 1]}}, divisions: {},
  sides: {{left: held, right: moved}}}}]}}
physics: plane_stress
materials: {{it: {{law: plastic, young: 1000, poisson: 0.3, formulation: {},
  hardening: {{linear: {{yield_stress: 1, modulus: 1}}}}}}}}
functions: {{grows: {{ramp: {{begin: 0, end: 1}}}}}}
supports: [{{on: held, fix: [x, y]}}, {{on: moved, y: {{value: 0.3, function: grows}}}}]
probes: {{force: {{on: moved, field: reaction}}}}
newton: {{tangent: full}}
time: {{scheme: static, step: 0.1, end: 1}}
)",
                             divisions, formulation));
}

Benchmark plastic_cantilever() {
  auto benchmark =
      benchmark_of(21, "plastic cantilever 10 × 1, plane stress, `enhanced`, moved by 0.3 (beam: 0.025)");
  for (const auto& [divisions, expected] : {std::pair("[20, 2]", 0.02660), std::pair("[20, 4]", 0.02673),
                                            std::pair("[10, 2]", 0.0279), std::pair("[40, 2]", 0.0261)}) {
    auto run = plastic_cantilever_run(divisions, "enhanced");
    run.to_end();
    benchmark.numbers.push_back(
        number(fmt::format("{}: force", divisions), run.probe("force.y"), expected, prototype));
    if (benchmark.residuals.empty())
      benchmark.residuals = run.hardest_step();
  }
  return benchmark;
}

Benchmark locked_cantilever() {
  auto run = plastic_cantilever_run("[20, 8]", "full");
  run.to_end();
  return benchmark_of(21, "the plastic cantilever with `full`",
                      {number("[20, 8]: force", run.probe("force.y"), 0.02963, prototype)});
}

// --- necking

constexpr double radius = 6.413, half_length = 26.667, waist = 0.982 * radius;

/// From the unit square to a quarter of a bar whose radius falls linearly to the middle, where layers are
/// thinner: z = L ζ^1.6.
Vector3d bar_shape(const Vector3d& x) {
  const double height = std::pow(x[1], 1.6);
  return {(waist + (radius - waist) * height) * x[0], half_length * height, 0};
}

/// Time is the elongation of the whole bar.
BulkRun necking_run(std::string_view divisions, std::string_view formulation, double end) {
  return BulkRun(fmt::format(R"(
mesh: {{generate: [{{name: bar, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: {},
  sides: {{left: axis, bottom: middle, top: end}}}}]}}
physics: axisymmetric
materials: {{it: {{law: plastic, young: 206.9, poisson: 0.29, strain: logarithmic{},
  hardening: {{voce: {{yield_stress: 0.45, saturation: 0.265, exponent: 16.93, modulus: 0.12924}}}}}}}}
functions: {{pull: {{times: [0, 20], values: [0, 10]}}}}
supports: [{{on: axis, fix: x}}, {{on: middle, fix: y}}, {{on: end, fix: x, y: {{value: 1, function: pull}}}}]
probes: {{force: {{on: end, field: reaction}}, waist: {{point: [{}, 0]}}}}
newton: {{tangent: full}}
time: {{scheme: static, step: 0.2, end: {}}}
)",
                             divisions, formulation, waist, end),
                 bar_shape);
}

double waist_of(const BulkRun& run) {
  return (waist + run.probe("waist.x")) / radius;
}

/// What is expected at the elongations 8 and 10.
struct Necked {
  std::string_view divisions;
  std::array<double, 2> force, waist;
};

Benchmark necking(const Necked& expected) {
  constexpr double step = 0.2, end = 10;
  auto run = necking_run(expected.divisions, "", end);
  auto benchmark = benchmark_of(
      22, fmt::format("necking (Simo 1988), logarithmic strain, `mean_dilatation`, {}", expected.divisions));
  double largest = 0, at_largest = 0;
  const auto go_to = [&](double elongation) {
    run.go_to(elongation);
    if (run.probe("force.y") > largest) {
      largest = run.probe("force.y");
      at_largest = elongation;
    }
  };
  for (int i = 1; i <= std::lround(8 / step); ++i)
    go_to(i * step);
  auto& numbers = benchmark.numbers;
  numbers.push_back(number("largest force", largest, 77.24, prototype));
  numbers.push_back(number("elongation there, ± one step", at_largest, 5.2, prototype, step / 5.2));
  for (const std::size_t i : {0U, 1U}) {
    const double elongation = i == 0 ? 8 : end;
    run.go_to(elongation);
    const auto at = fmt::format("ΔL = {}: ", elongation);
    numbers.push_back(number(at + "force", run.probe("force.y"), expected.force[i], prototype));
    numbers.push_back(number(at + "radius of the neck / R", waist_of(run), expected.waist[i], prototype));
  }
  benchmark.residuals = run.hardest_step();
  return benchmark;
}

Benchmark locked_bar() {
  auto run = necking_run("[10, 20]", ", formulation: full", 14);
  run.to_end();
  return benchmark_of(22, "the bar with `full`, where it does not neck",
                      {number("ΔL = 14: radius of the middle / R", waist_of(run), 0.711, prototype)});
}

} // namespace

std::vector<Benchmark> structure_benchmarks() {
  return {incompressible_membrane(32),
          lame_tube(16),
          elastic_cantilever("[20, 2, 2]"),
          hill_tube(0.4999),
          hill_tube(0.3),
          rubber_tube(8),
          rubber_membrane({{4, 6.020}, {8, 6.619}, {16, 6.814}, {32, 6.884}}),
          elastica(false, "[50, 1]"),
          elastica(true, "[50, 1, 1]"),
          plastic_cantilever(),
          necking({"[10, 20]", {69.1, 56.7}, {0.798, 0.668}})};
}

std::vector<Benchmark> locked_structures() {
  return {locked_rubber_tube(), locked_elastica(true, "[50, 1, 1]", 0.110, 0.629), locked_cantilever(),
          locked_bar()};
}

std::vector<Benchmark> finer_structures() {
  return {incompressible_membrane(128),
          elastic_cantilever("[40, 4, 4]"),
          rubber_tube(16),
          rubber_membrane({{64, 6.912}}),
          necking({"[14, 28]", {68.9, 56.2}, {0.796, 0.665}}),
          rubber_membrane(", formulation: full", {{64, 3.90}}, "the rubber membrane with `full`"),
          locked_elastica(false, "[400, 4]", 0.2941, 0.8075)};
}

} // namespace rubato::verification
