// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/sdnl140.hpp"

#include <fmt/format.h>

#include "support/scratch_folder.hpp"
#include "support/shared_files.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace rubato::verification {
namespace {

struct Modeling {
  std::string file;
  std::string generated; ///< empty: only from a file
  std::string physics;
  std::string clamps; ///< of the file
  std::string load;
  std::string node; ///< where the file's history is reported
  std::string point;
  std::string excluded; ///< of the file
  std::string more;     ///< further entries of the contact zone
};

std::string boxes(const std::string& cells) {
  return fmt::format(R"({{generate: [
    {{name: Haut, box: {{from: [0, 0, 0], to: [1, 0.1, 0.1]}}, divisions: [20, 2, 1], cells: {0},
     sides: {{left: Haut_Encastre, bottom: Haut_Contact}}, edges: {{right_top: Haut_Pression}}}},
    {{name: Bas, box: {{from: [0, -0.1, 0], to: [1, 0, 0.1]}}, divisions: [20, 2, 1], cells: {0},
     sides: {{left: Bas_Encastre, top: Bas_Contact}}}}]}})",
                     cells);
}

const std::string rectangles = R"({generate: [
    {name: Haut, rectangle: {from: [0, 0], to: [1, 0.1]}, divisions: [20, 2], cells: quad4,
     sides: {left: Encastrement, bottom: Haut_Contact}, points: {right_top: Force}},
    {name: Bas, rectangle: {from: [0, -0.1], to: [1, 0]}, divisions: [20, 2], cells: quad4,
     sides: {left: Encastrement, top: Bas_Contact}}]})";

const std::string beam_clamps = "[{on: Haut_Encastre, fix: [x, y, z]}, {on: Bas_Encastre, fix: [x, y, z]}]";
const std::string line_load = "line_force: {on: Haut_Pression, y: -1e7}";

/// Modeling D's histories carry Code_Aster's tangents at clamped projections.
Modeling modeling(char letter) {
  switch (letter) {
  case 'a':
  case 'b':
    return {fmt::format("sdnl140{}.med", letter),
            "",
            "solid",
            beam_clamps,
            line_load,
            "N90",
            "",
            "N529, N530, N531",
            "projection_tolerance: 0.5,"};
  case 'c':
  case 'e':
    return {"sdnl140c.med", boxes("hexa8"), "solid",    beam_clamps, line_load,
            "N7",           "1, 0.1, 0",    "N11, N12", ""};
  case 'd':
    return {"sdnl140d.med", boxes("hexa27"),  "solid",
            beam_clamps,    line_load,        "N50",
            "1, 0.1, 0.1",  "N91, N434, N94", "clamped_normal: code_aster,"};
  case 'f':
    return {"sdnl140f.med",
            rectangles,
            "plane_stress",
            "[{on: Encastrement, fix: [x, y]}]",
            "nodal_force: {on: Force, y: -1e7}",
            "Force",
            "1, 0.1",
            "N6",
            ""};
  default:
    throw InputError(fmt::format("found modeling '{}', expected a to f", letter));
  }
}

std::string deck_text(char letter, MeshFrom from) {
  const auto m = modeling(letter);
  const bool generated = from == MeshFrom::generator;
  if (generated && m.generated.empty())
    throw InputError(fmt::format("modeling {} has no generated mesh", letter));
  const std::string convert = letter == 'd' ? ", convert: full_quadratic" : "";
  const auto mesh = generated
                        ? m.generated
                        : fmt::format("{{file: \"{}\"{}}}", (sdnl140_folder() / m.file).string(), convert);
  const auto probe = generated ? fmt::format("point: [{}]", m.point) : fmt::format("node: {}", m.node);
  const auto excluded = !generated ? m.excluded : letter == 'f' ? "Encastrement" : "Bas_Encastre";
  const auto scheme = letter == 'e' ? "scheme: newmark" : "scheme: hht, alpha: -0.3";
  return fmt::format(R"(title: SDNL140 {}
mesh: {}
physics: {}
materials: {{steel: {{young: 200e9, poisson: 0, density: 7800}}}}
supports: {}
loads: [{{{}}}]
contact:
  interface: {{master: Haut_Contact, slave: Bas_Contact, integration: nodes, friction: 0.2, {} exclude_nodes: [{}]}}
time: {{{}, step: 1e-3, end: 0.012, start: at_rest_unloaded}}
newton: {{residual: 1e-9}}
probes: {{tip: {{{}}}}}
)",
                     letter, mesh, m.physics, m.clamps, m.load, m.more, excluded, scheme, probe);
}

const std::vector<double>* row_at(const results::Table& table, double t) {
  constexpr double same_instant = 1e-9;
  const auto row = std::ranges::find_if(
      table.rows, [&](const auto& values) { return std::abs(values.front() - t) < same_instant; });
  return row == table.rows.end() ? nullptr : &*row;
}

} // namespace

std::filesystem::path sdnl140_folder() {
  return test::shared_file("sdnl140");
}

study::Study sdnl140(char letter, MeshFrom from, const std::vector<deck::Setting>& changes) {
  return deck::parse_deck(deck_text(letter, from), "sdnl140.yaml", changes).runs.front();
}

std::vector<deck::Setting> without_contact() {
  return {{"contact", "~"}};
}

Finished finish(const study::Study& study) {
  const test::ScratchFolder folder;
  Finished finished;
  finished.result = run::run_study(study, folder.path(), {});
  finished.probes = results::read_csv(folder / "probes.csv");
  return finished;
}

Deviation deviation(const results::Table& probes, const results::Table& reference, double until) {
  const auto computed_column = static_cast<std::size_t>(probes.column("tip.y"));
  const auto reference_column = static_cast<std::size_t>(reference.column("dy"));
  Deviation found;
  for (const auto& row : reference.rows) {
    const double t = row.front();
    if (t > until)
      break;
    const double expected = row[reference_column];
    found.peak = std::max(found.peak, std::abs(expected));
    const auto* computed = row_at(probes, t);
    if (computed == nullptr) {
      ++found.missing;
      continue;
    }
    ++found.instants;
    found.value = (*computed)[computed_column];
    if (const double difference = std::abs(found.value - expected); difference > found.largest) {
      found.largest = difference;
      found.at = t;
    }
  }
  return found;
}

double largest_difference(const Finished& one, const Finished& other) {
  const auto same_instant = [](const auto& a, const auto& b) {
    return a.size() == b.size() && a.front() == b.front();
  };
  if (!std::ranges::equal(one.probes.rows, other.probes.rows, same_instant))
    return std::nan("");
  const auto& u = other.result.end.motion.u;
  double largest = u.lpNorm<Eigen::Infinity>();
  double difference = (one.result.end.motion.u - u).lpNorm<Eigen::Infinity>();
  for (std::size_t i = 0; i < other.probes.rows.size(); ++i)
    for (std::size_t j = 1; j < other.probes.rows[i].size(); ++j) {
      largest = std::max(largest, std::abs(other.probes.rows[i][j]));
      difference = std::max(difference, std::abs(one.probes.rows[i][j] - other.probes.rows[i][j]));
    }
  return difference / largest;
}

std::optional<results::Table> history(const std::string& name) {
  const auto file = sdnl140_folder() / "code_aster" / (name + ".csv");
  if (!std::filesystem::exists(file))
    return std::nullopt;
  return results::read_csv(file);
}

} // namespace rubato::verification
