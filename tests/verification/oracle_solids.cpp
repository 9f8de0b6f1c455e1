// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/oracle_solids.hpp"

#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

#include "support/walk.hpp"
#include "verification/oracle_files.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string_view>

namespace rubato::verification {
namespace {

using Eigen::VectorXd;

/// What a material has beside E, ν and its density.
struct Behaviour {
  std::string_view code; ///< in the names of files
  std::string_view what;
  std::string_view keys;
  double load; ///< [N/m] in space, [N] in the plane
};

constexpr std::string_view linear_hardening =
    "law: plastic, hardening: {linear: {yield_stress: 400e6, tangent_modulus: 2e9}}";
constexpr std::string_view prager =
    "law: plastic, hardening: {linear: {yield_stress: 400e6, modulus: 0}}, kinematic: {modulus: "
    "2.02020202020202020e9}";
/// Code_Aster's PRAGER C of 1e9 is two thirds of ours.
constexpr std::string_view mixed =
    "law: plastic, hardening: {linear: {yield_stress: 400e6, modulus: 0.52020202020202020e9}}, "
    "kinematic: {modulus: 1.5e9}";
constexpr std::string_view chaboche =
    "law: plastic, hardening: {voce: {yield_stress: 300e6, saturation: 100e6, exponent: 20}}, "
    "kinematic: {modulus: 40e9, recall: 200}";
constexpr std::string_view table =
    "law: plastic, hardening: {tension_table: [[0.002, 400e6], [0.004, 430e6], [0.008, 460e6], [0.03, "
    "500e6]]}";

const std::array<Behaviour, 11> behaviours{
    {{"petit_elas_nu03", "linear elastic", "strain: small", 1e7},
     {"isot_line", "plastic, linear hardening", linear_hardening, 2e6},
     {"isot_trac", "plastic, hardening by a table", table, 2e6},
     {"cine_line", "plastic, Prager", prager, 2e6},
     {"ecmi_line", "plastic, linear and Prager", mixed, 2e6},
     {"cin1_chab", "plastic, Voce and Armstrong-Frederick", chaboche, 2e6},
     {"gdep_elas", "elastic, Green-Lagrange", "strain: green_lagrange", 1e7},
     {"log_elas", "elastic, logarithmic", "strain: logarithmic", 1e7},
     {"log_isot", "plastic, logarithmic", "LINEAR, strain: logarithmic", 2e6},
     {"sm_elas", "elastic, logarithmic beside SIMO_MIEHE", "strain: logarithmic", 1e7},
     {"sm_isot", "plastic, logarithmic beside SIMO_MIEHE", "LINEAR, strain: logarithmic", 2e6}}};

std::string keys_of(const Behaviour& behaviour) {
  std::string keys(behaviour.keys);
  if (keys.starts_with("LINEAR"))
    keys.replace(0, std::string_view("LINEAR").size(), linear_hardening);
  return keys;
}

std::string beam_deck(const std::string& file, const std::string& physics, const Behaviour& behaviour,
                      double load, bool reverses) {
  const bool solid = physics == "solid";
  const std::string_view z = solid ? ", z" : "";
  return fmt::format(R"(mesh: {{generate: {}}}
physics: {}
materials: {{steel: {{young: 200e9, poisson: 0.3, density: 7800, formulation: full, {}}}}}
functions: {{course: {}}}
supports: [{{on: Haut_Encastre, fix: [x, y{}]}}, {{on: Bas_Encastre, fix: [x, y{}]}}]
loads: [{{{}: {{on: {}, y: {:g}, function: course}}}}]
contact: {{interface: {{master: Haut_Contact, slave: Bas_Contact, integration: nodes, projection_tolerance: 0.5, friction: 0.2,
  exclude_nodes: [Bas_Encastre]}}}}
newton: {{residual: 1.0e-9}}
time: {{scheme: hht, alpha: -0.3, start: at_rest_unloaded, instants: {}}}
)",
                     oracle_beams(solid), physics, keys_of(behaviour),
                     reverses ? "{times: [0, 0.003, 0.004, 0.012], values: [1, 1, -1, -1]}"
                              : "{times: [0, 1], values: [1, 1]}",
                     z, z, solid ? "line_force" : "nodal_force", solid ? "edge" : "tip", -load,
                     oracle_instants(file));
}

void add_beam(const std::string& prefix, const std::string& physics, const Behaviour& behaviour,
              const std::string& suffix, std::vector<OracleSolid>& studies) {
  const auto file = fmt::format("{}_{}{}", prefix, behaviour.code, suffix);
  if (!has_oracle_file(file))
    return;
  const bool reverses = suffix == "_rev";
  const double load = suffix == "_21" ? 2.1e6 : suffix == "_5e6" ? 5e6 : behaviour.load;
  studies.push_back({.file = file,
                     .what = fmt::format("two beams, {}, {}{}", physics, behaviour.what,
                                         reverses ? ", the load reverses" : ""),
                     .deck = beam_deck(file, physics, behaviour, load, reverses),
                     .stands_beside = behaviour.code.starts_with("sm_")});
}

void add_beams(std::vector<OracleSolid>& studies) {
  for (const auto& behaviour : behaviours)
    for (const auto& [prefix, physics] :
         {std::pair("c", "solid"), std::pair("fdp", "plane_strain"), std::pair("fcp", "plane_stress")})
      for (const auto* suffix : {"", "_rev", "_21", "_5e6"})
        add_beam(prefix, physics, behaviour, suffix, studies);
}

void add_block(const std::string& cells, bool sticks, std::vector<OracleSolid>& studies) {
  const auto file = fmt::format("hyper_{}_{}", cells == "hexa8" ? "h8" : "h20", sticks ? "stick" : "free");
  if (!has_oracle_file(file))
    return;
  const std::string held = sticks ? "{on: low, fix: [x, y, z]}, {on: top, fix: [x, y]}"
                                  : "{on: low, fix: [z]}, {on: side, fix: [x]}, {on: under, fix: [y]}";
  auto deck = fmt::format(
      R"(mesh: {{generate: [{{name: block, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [4, 4, 4],
  cells: {}, sides: {{left: side, bottom: under, back: low, front: top}}}}]}}
physics: solid
materials: {{rubber: {{law: hyperelastic, c10: 4e5, c01: 1e5, bulk: 2e7, volumetric: quadratic, formulation: full}}}}
functions: {{ramp: {{ramp: {{begin: 0, end: 1}}}}}}
supports: [{}, {{on: top, z: {{value: -0.3, function: ramp}}}}]
newton: {{residual: 1.0e-10}}
time: {{scheme: static, step: 0.1, end: 1}}
)",
      cells, held);
  studies.push_back(
      {.file = file,
       .what = fmt::format("block of Mooney-Rivlin rubber, {}, {}", cells == "hexa8" ? "HEXA8" : "HEXA20",
                           sticks ? "sticks to both plates" : "slides on both plates"),
       .deck = std::move(deck),
       .is_reaction = true});
}

/// The tip is the corner that the file is of.
void add_pressed(const std::string& file, const std::string& cells, bool follows,
                 std::vector<OracleSolid>& studies) {
  if (!has_oracle_file(file))
    return;
  auto deck = fmt::format(R"(mesh:
  generate: [{{name: beam, box: {{from: [0, 0, 0], to: [1, 0.1, 0.1]}}, divisions: [20, 2, 1], cells: {},
    sides: {{left: clamp}}, points: {{{}: tip}}}}]
  groups: {{pressed: {{box: {{from: [-1, 0.04, -1], to: [2, 0.2, 1]}}, of: beam, take: faces}}}}
physics: solid
materials: {{steel: {{young: 200e9, poisson: 0.3, strain: green_lagrange, formulation: full}}}}
functions: {{ramp: {{ramp: {{begin: 0, end: 1}}}}}}
supports: [{{on: clamp, fix: [x, y, z]}}]
loads: [{{pressure: {{on: pressed, value: 1.333e8, function: ramp, follower: {}}}}}]
newton: {{residual: 1.0e-10}}
time: {{scheme: static, step: 0.1, end: 1}}
)",
                          cells, cells == "hexa8" ? "right_top_back" : "right_top_front", follows);
  studies.push_back({.file = file,
                     .what = fmt::format("one beam, {}, {}", cells == "hexa8" ? "HEXA8" : "HEXA20",
                                         follows ? "pressure that follows the faces" : "dead pressure"),
                     .deck = std::move(deck)});
}

double reaction_along_z(const test::Walk& walk, const std::string& group) {
  double sum = 0;
  for (const auto node : mesh::find_nodes(walk.model.mesh, group).nodes)
    sum += walk.state().reaction[walk.model.dofs.dof(node, 2)];
  return sum;
}

VectorXd value_of(const OracleSolid& study, const test::Walk& walk) {
  if (study.is_reaction)
    return VectorXd::Constant(1, reaction_along_z(walk, "top"));
  const auto tip = mesh::find_nodes(walk.model.mesh, "tip").nodes.front();
  return walk.state().motion.u.segment(walk.model.dofs.dof(tip, 0), walk.model.dofs.components);
}

} // namespace

std::vector<OracleSolid> oracle_solids() {
  std::vector<OracleSolid> studies;
  add_beams(studies);
  for (const auto* cells : {"hexa8", "hexa20"})
    for (const bool sticks : {true, false})
      add_block(cells, sticks, studies);
  add_pressed("c_dead", "hexa8", false, studies);
  add_pressed("c_follow", "hexa8", true, studies);
  add_pressed("d20_follow", "hexa20", true, studies);
  return studies;
}

SolidDeviation compare(const OracleSolid& study) {
  const auto rows = oracle_table(study.file);
  test::Walk walk(study.deck);
  double peak = 0;
  SolidDeviation found;
  for (const auto& row : rows) {
    if (row.front() == 0)
      continue;
    if (!walk.advance())
      throw std::runtime_error(study.file + " did not come to its end");
    const auto value = value_of(study, walk);
    const VectorXd expected = Eigen::Map<const VectorXd>(row.data() + 1, value.size());
    peak = std::max(peak, expected.lpNorm<Eigen::Infinity>());
    found.largest = std::max(found.largest, (value - expected).lpNorm<Eigen::Infinity>());
    found.others += static_cast<int>(row.back());
    ++found.rows;
  }
  for (const auto& report : walk.reports) {
    found.iterations += report.iterations;
    found.bulk += report.bulk_iterations;
    found.factorisations += report.factorisations;
  }
  found.largest /= peak;
  const auto& energy = walk.simulation.energy();
  found.balance = std::abs(energy.balance()) / energy.largest();
  return found;
}

} // namespace rubato::verification
