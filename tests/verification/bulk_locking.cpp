// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/bulk_locking.hpp"

#include <fmt/format.h>

#include "verification/bulk_decks.hpp"
#include "verification/bulk_run.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string_view>

namespace rubato::verification {
namespace {

using Eigen::Vector3d;

/// The displacement of a structure whose cells have that formulation.
using Displacement = std::function<double(std::string_view formulation)>;

/// Numbers of the prototype; 0 where the cells do not have the formulation.
struct Expected {
  double full = 0, mean_dilatation = 0, enhanced = 0;
  double digit = 0; ///< the last one of all of them
};

LockingRow row(std::string what, double exact, const Expected& expected, const Displacement& displacement) {
  const auto number = [&](std::string_view formulation, double value) -> std::optional<LockingNumber> {
    if (value == 0)
      return std::nullopt;
    return LockingNumber{displacement(formulation), value, expected.digit};
  };
  return {.what = std::move(what),
          .exact = exact,
          .full = number("full", expected.full),
          .mean_dilatation = number("mean_dilatation", expected.mean_dilatation),
          .enhanced = number("enhanced", expected.enhanced)};
}

double result_of(const std::string& deck, const std::string& probe, const MeshShape& shape = {}) {
  BulkRun run(deck, shape);
  run.to_end();
  return run.probe(probe);
}

// --- Cook's membrane

struct Cook {
  std::string_view physics, elastic;
  double force = 0;
  double height = 60; ///< of the place at the right end that is looked at
};

constexpr Cook flat{
    .physics = "plane_stress", .elastic = "young: 1, poisson: 0.33333333333333333", .force = 1, .height = 52};
constexpr Cook compressible{.physics = "plane_strain", .elastic = "young: 250, poisson: 0.3", .force = 100};
constexpr Cook incompressible{
    .physics = "plane_strain", .elastic = "young: 250, poisson: 0.4999", .force = 100};
constexpr Cook incompressible_middle{
    .physics = "plane_strain", .elastic = "young: 250, poisson: 0.4999", .force = 100, .height = 52};

double cook(const Cook& membrane, int n, std::string_view formulation) {
  const auto material = fmt::format("{}, formulation: {}", membrane.elastic, formulation);
  return result_of(cook_deck(n, membrane.physics, material, membrane.force),
                   membrane.height == 60 ? "corner.y" : "middle.y", cook_shape);
}

void add_cook(std::vector<LockingRow>& rows, const std::string& what, const Cook& membrane, double exact,
              const std::vector<std::pair<int, Expected>>& meshes) {
  for (const auto& [n, expected] : meshes)
    rows.push_back(row(fmt::format("Cook, {}, (48, {}), {} × {}", what, membrane.height, n, n), exact,
                       expected,
                       [&, n = n](std::string_view formulation) { return cook(membrane, n, formulation); }));
}

void add_membranes(std::vector<LockingRow>& rows, int finest) {
  const auto add = [&](const std::string& what, const Cook& membrane, double exact,
                       std::vector<std::pair<int, Expected>> meshes) {
    std::erase_if(meshes, [&](const auto& mesh) { return mesh.first > finest; });
    add_cook(rows, what, membrane, exact, meshes);
  };
  add("plane stress, ν = 1/3", flat, 23.97,
      {{16, {.full = 23.43, .enhanced = 23.88, .digit = 1e-2}},
       {32, {.full = 23.82, .enhanced = 23.94, .digit = 1e-2}},
       {128, {.full = 23.95, .enhanced = 23.964, .digit = 1e-2}}});
  add("plane strain, ν = 0.3", compressible, 9.22,
      {{16, {8.866, 9.015, 9.094, 1e-3}}, {128, {9.198, 9.207, 9.208, 1e-3}}});
  add("plane strain, ν = 0.4999", incompressible, 7.77,
      {{16, {2.31, 7.591, 7.605, 1e-3}},
       {64, {4.03, 7.737, 7.734, 1e-3}},
       {128, {5.69, 7.755, 7.753, 1e-3}}});
  add("plane strain, ν = 0.4999", incompressible_middle, 7.405, {{128, {5.58, 7.397, 7.396, 1e-3}}});
}

// --- tube 20 to 40 under the inner pressure 1

constexpr double stiffness = 10;

Tube tube_of(int cells) {
  return {.inner = 20, .outer = 40, .cells = cells};
}

double widening(double poisson) {
  return lame_widening(tube_of(1), stiffness, poisson);
}

double meridian(int n, double poisson, std::string_view formulation) {
  const auto material =
      fmt::format("young: {}, poisson: {}, formulation: {}", stiffness, poisson, formulation);
  return result_of(tube_deck(tube_of(n), material, "", tube_pressure), "inner.x");
}

/// From the unit square or cube to a quarter of the tube.
Vector3d quarter_shape(const Vector3d& x) {
  const double radius = 20 + 20 * x[0], angle = std::numbers::pi / 2 * x[1];
  return {radius * std::cos(angle), radius * std::sin(angle), x[2]};
}

double quarter(bool solid, std::string_view formulation) {
  const auto deck = fmt::format(
      R"(
mesh: {{generate: [{{name: tube, {},
  sides: {{left: inner, bottom: low, top: high{}}}}}]}}
physics: {}
materials: {{it: {{young: {}, poisson: 0.4999, formulation: {}}}}}
supports: [{{on: low, fix: y}}, {{on: high, fix: x}}{}]
loads: [{{pressure: {{on: inner, value: 1}}}}]
probes: {{there: {{point: {}}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
      solid ? "box: {from: [0, 0, 0], to: [1, 1, 2.5]}, divisions: [8, 16, 1]"
            : "rectangle: {from: [0, 0], to: [1, 1]}, divisions: [8, 16]",
      solid ? ", back: behind, front: before" : "", solid ? "solid" : "plane_strain", stiffness, formulation,
      solid ? ", {on: behind, fix: z}, {on: before, fix: z}" : "", solid ? "[20, 0, 0]" : "[20, 0]");
  return result_of(deck, "there.x", quarter_shape);
}

void add_tubes(std::vector<LockingRow>& rows) {
  rows.push_back(row("tube, ν = 0.3, axisymmetric, 8 cells", widening(0.3), {3.8036, 3.8096, 3.8053, 1e-4},
                     [](std::string_view formulation) { return meridian(8, 0.3, formulation); }));
  const std::vector<std::pair<int, Expected>> meshes{
      {4, {0.24, 3.983, 3.950, 1e-2}}, {8, {0.79, 3.996, 3.987, 1e-2}}, {16, {1.98, 3.999, 3.997, 1e-2}}};
  for (const auto& [n, expected] : meshes)
    rows.push_back(row(fmt::format("tube, ν = 0.4999, axisymmetric, {} cells", n), widening(0.4999), expected,
                       [n = n](std::string_view formulation) { return meridian(n, 0.4999, formulation); }));
  for (const bool solid : {false, true})
    rows.push_back(row(fmt::format("tube, ν = 0.4999, {} 8 × 16", solid ? "HEXA8" : "QUAD4"),
                       widening(0.4999), {0.79, 3.992, 3.987, 1e-2},
                       [&](std::string_view formulation) { return quarter(solid, formulation); }));
}

// --- cantilever 20 × 2 × 2 with E = 1 under a tip force of 1

struct Beam {
  std::string_view divisions;
  std::string_view cells = "hexa8";
  double skew = 0;
};

double cantilever(const Beam& beam, double poisson, std::string_view formulation) {
  const auto deck = beam_deck(beam.divisions, beam.cells,
                              fmt::format("young: 1, poisson: {}, formulation: {}", poisson, formulation));
  return result_of(deck, "end.z", [&](const Vector3d& x) -> Vector3d {
    return x + Vector3d(beam.skew * (x[1] - 1) * std::sin(std::numbers::pi * x[0] / 20), 0, 0);
  });
}

void add_beam(std::vector<LockingRow>& rows, const Beam& beam, double poisson, const Expected& expected) {
  constexpr double compressible_tip = 2000, incompressible_tip = 1970;
  std::string cells = beam.cells == "hexa8" ? "HEXA8" : "PENTA6";
  rows.push_back(row(fmt::format("cantilever, ν = {}, {} {}{}", poisson, cells, beam.divisions,
                                 beam.skew > 0 ? fmt::format(", skewed by {}", beam.skew) : ""),
                     poisson < 0.4 ? compressible_tip : incompressible_tip, expected,
                     [&](std::string_view formulation) { return cantilever(beam, poisson, formulation); }));
}

void add_beams(std::vector<LockingRow>& rows) {
  constexpr std::string_view coarse = "[10, 2, 2]", middle = "[20, 2, 2]", fine = "[40, 4, 4]";
  add_beam(rows, {coarse}, 0.3, {1390, 1531, 1969, 1});
  add_beam(rows, {middle}, 0.3, {1752, 1967, 1989, 1});
  add_beam(rows, {fine}, 0.3, {1930, 1987, 1996, 1});
  add_beam(rows, {coarse}, 0.4999, {167, 1521, 1854, 1});
  add_beam(rows, {middle}, 0.4999, {385, 1905, 1927, 1});
  add_beam(rows, {fine}, 0.4999, {701, 1948, 1954, 1});
  add_beam(rows, {.divisions = coarse, .skew = 0.5}, 0.3, {1354, 1485, 1968, 1});
  add_beam(rows, {coarse, "penta6"}, 0.4999, {.full = 391, .mean_dilatation = 1277, .digit = 1});
  add_beam(rows, {middle, "penta6"}, 0.4999, {.full = 847, .mean_dilatation = 1745, .digit = 1});
  add_beam(rows, {"[10, 1, 1]"}, 0.3, {1296, 2413, 1991, 1});
}

} // namespace

bool holds(const LockingNumber& number, double exact) {
  constexpr double tolerance = 5e-3;
  const double deviation = std::abs(number.found - number.expected);
  return deviation <= std::max(tolerance * std::abs(number.expected), 0.5 * number.digit) ||
         std::abs(number.found - exact) <= std::abs(number.expected - exact);
}

std::vector<LockingRow> locking_rows(int finest) {
  std::vector<LockingRow> rows;
  add_membranes(rows, finest);
  add_tubes(rows);
  add_beams(rows);
  return rows;
}

} // namespace rubato::verification
