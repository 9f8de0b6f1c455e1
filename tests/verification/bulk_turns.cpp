// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/bulk_turns.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "verification/bulk_run.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {
namespace {

/// Young's modulus is 1 of all of them, of rubbers 3μ but for the bulk modulus.
struct TurnedLaw {
  std::string_view name;
  std::string_view keys;
  std::string_view keys_of_sheets = {}; ///< in plane stress, when they are others
  bool can_be_enhanced = false;
};

constexpr std::array<TurnedLaw, 8> turned_laws{
    {{"elastic, Green-Lagrange", "young: 1, poisson: 0.3, strain: green_lagrange", {}, true},
     {"orthotropic, Green-Lagrange",
      "law: orthotropic, young_x: 1, young_y: 0.5, young_z: 0.3, poisson_xy: 0.3, poisson_yz: 0.2, "
      "poisson_xz: "
      "0.1, shear_xy: 0.2, SHEARS angle_z: 20, strain: green_lagrange",
      "law: orthotropic, young_x: 1, young_y: 0.5, poisson_xy: 0.3, shear_xy: 0.2, angle_z: 20, strain: "
      "green_lagrange",
      true},
     {"elastic, logarithmic", "young: 1, poisson: 0.3, strain: logarithmic"},
     {"plastic, logarithmic",
      "law: plastic, young: 1, poisson: 0.3, hardening: {linear: {yield_stress: 1e-3, "
      "modulus: 0.01}}, strain: logarithmic"},
     {"Prony, logarithmic",
      "law: prony, young: 1, poisson: 0.3, terms: [{shear: 2, time: 0.1}], strain: logarithmic"},
     {"neo-Hookean", "law: hyperelastic, c10: 0.1666666666666666667, bulk: 20"},
     {"Yeoh", "law: yeoh, c10: 0.1666666666666666667, c20: -0.01, c30: 0.001, bulk: 20"},
     {"Ogden",
      "law: ogden, terms: [{shear: 0.3, exponent: 1.3}, {shear: 0.0333333333333333333, exponent: -2}], bulk: "
      "20"}}};

struct TurnedBody {
  std::string_view physics, cells, formulation;
};

constexpr std::array<TurnedBody, 17> turned_bodies{{{"solid", "hexa8", "full"},
                                                    {"solid", "hexa8", "mean_dilatation"},
                                                    {"solid", "hexa8", "enhanced"},
                                                    {"solid", "penta6", "full"},
                                                    {"solid", "penta6", "mean_dilatation"},
                                                    {"solid", "tetra4", "full"},
                                                    {"solid", "tetra10", "full"},
                                                    {"solid", "hexa20", "full"},
                                                    {"solid", "hexa27", "full"},
                                                    {"solid", "penta15", "full"},
                                                    {"plane_strain", "quad4", "full"},
                                                    {"plane_strain", "quad4", "mean_dilatation"},
                                                    {"plane_strain", "quad4", "enhanced"},
                                                    {"plane_strain", "quad8", "full"},
                                                    {"plane_stress", "quad4", "full"},
                                                    {"plane_stress", "quad4", "enhanced"},
                                                    {"plane_stress", "tria6", "full"}}};

std::string keys_of(const TurnedLaw& law, const TurnedBody& body) {
  if (body.physics == "plane_stress" && !law.keys_of_sheets.empty())
    return std::string(law.keys_of_sheets);
  std::string keys(law.keys);
  constexpr std::string_view shears = "SHEARS";
  if (const auto at = keys.find(shears); at != std::string::npos)
    keys.replace(at, shears.size(), body.physics == "solid" ? "shear_yz: 0.15, shear_xz: 0.1," : "");
  return keys;
}

std::string turned_deck(const TurnedLaw& law, const TurnedBody& body, const Eigen::AngleAxisd& turn) {
  const bool solid = body.physics == "solid";
  const auto axis = turn.axis();
  return fmt::format(R"(mesh:
  generate: [{{name: block, {}, cells: {}}}]
  groups: {{skin: {{skin: all}}, hull: {{nodes_of: skin}}}}
physics: {}
materials: {{any: {{{}, formulation: {}}}}}
functions: {{course: {{ramp: [0, 1]}}}}
supports: [{{on: hull, rotate: {{{}, angle: {{value: {:.17g}, function: course}}}}}}]
time: {{scheme: static, step: 0.25, end: 1}}
probes:
  most: {{on: all, take: max, field: stress, place: gauss_points}}
  least: {{on: all, take: min, field: stress, place: gauss_points}}
)",
                     solid ? "box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2]"
                           : "rectangle: {from: [0, 0], to: [1, 1]}, divisions: [3, 3]",
                     body.cells, body.physics, keys_of(law, body), body.formulation,
                     solid ? fmt::format("about: [0.3, 0.2, 0.1], axis: [{:.17g}, {:.17g}, {:.17g}]", axis[0],
                                         axis[1], axis[2])
                           : "about: [0.3, 0.2]",
                     turn.angle());
}

double largest_stress(const std::string& deck) {
  BulkRun run(deck);
  run.to_end();
  double largest = 0;
  for (const auto* component : {"xx", "yy", "zz", "xy", "yz", "xz"})
    for (const auto* probe : {"most", "least"})
      largest = std::max(largest, std::abs(run.probe(fmt::format("{}.{}", probe, component))));
  return largest;
}

/// Of the bodies of a formulation, solids alone where the turn is one in space.
double largest_stress(const TurnedLaw& law, std::string_view formulation, const Eigen::AngleAxisd& turn,
                      bool in_plane) {
  double largest = 0;
  for (const auto& body : turned_bodies)
    if (body.formulation == formulation && (in_plane || body.physics == "solid"))
      largest = std::max(largest, largest_stress(turned_deck(law, body, turn)));
  return largest;
}

/// A number that is at most `bound`, and not negative.
BenchmarkNumber at_most(std::string quantity, double found, double bound) {
  return {std::move(quantity), found, bound / 2, 1,
          "rounding: half of the bound, and as much off it at most"};
}

} // namespace

Benchmark rigid_turns() {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  const AngleAxisd quarter(std::numbers::pi / 2, Vector3d::UnitZ());
  const AngleAxisd both(AngleAxisd(0.7, Vector3d::UnitX()) * AngleAxisd(1.1, Vector3d::UnitZ()));
  Benchmark out{
      29,
      "blocks whose hulls turn by 90° in four steps, and by 1.1 about z and then by 0.7 about x; E = 1, "
      "nodes inside are free",
      {},
      {}};
  for (const auto& law : turned_laws)
    for (const std::string_view formulation : {"full", "mean_dilatation", "enhanced"}) {
      if (formulation == "enhanced" && !law.can_be_enhanced)
        continue;
      const auto name = fmt::format("{}, {}: largest stress over E", law.name, formulation);
      out.numbers.push_back(at_most(name + ", 90°", largest_stress(law, formulation, quarter, true), 1e-10));
      out.numbers.push_back(
          at_most(name + ", 1.1 and 0.7", largest_stress(law, formulation, both, false), 1e-12));
    }
  return out;
}

} // namespace rubato::verification
