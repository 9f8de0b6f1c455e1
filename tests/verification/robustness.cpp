// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/robustness.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/results/csv.hpp"

#include <fmt/format.h>

#include "support/scratch_folder.hpp"
#include "verification/dice.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rubato::verification {
namespace {

/// What is drawn for a variant, before it is a deck.
struct Draw {
  std::string cells;      ///< of the upper beam
  std::string lower_kind; ///< of the lower beam
  bool plane = false;
  int refine = 1;
  int upper_cells = 20;
  int lower_cells = 20;
  int lower_across = 1; ///< cells of the lower beam across
  double gap = 0;       ///< < 0: overlap
  double shift = 0;
  double poisson = 0;
  double load = 1;
  double friction = 0;
  std::string contact;
  std::string numbers; ///< the method's own keys
  bool slave_above = false;
  Integration integration = Integration::nodes;
  std::string scheme;
  std::string time; ///< the scheme's own keys
  bool redistributed = false;
  double step = 0;
  int steps = 0;
};

constexpr std::string_view by_mortar = ", integration: mortar", on_nodes = ", integration: nodes";

std::string level(Dice& dice) {
  return dice.one_of({"newton", "fixed_point"});
}

void draw_linear_cells(Dice& dice, Meshes meshes, Draw& draw) {
  draw.cells = dice.one_of({"tetra4", "hexa8", "quad4", "quad4"});
  draw.lower_kind = draw.cells;
  draw.plane = draw.cells == "quad4";
  const bool refined = dice.chance(draw.plane ? 0.3 : 0.1);
  draw.refine = refined && meshes == Meshes::any ? (draw.plane ? dice.whole(2, 4) : 2) : 1;
  if (dice.chance(0.4))
    draw.lower_cells = dice.whole(15, 27);
}

std::string any_cells(Dice& dice, bool plane) {
  return plane ? dice.one_of({"quad4", "quad8", "quad9", "tria3", "tria6"})
               : dice.one_of({"hexa8", "hexa20", "hexa27", "tetra4", "tetra10", "penta6", "penta15"});
}

/// Of every kind; half of the meshes do not match, some of them not in their kind either.
void draw_any_cells(Dice& dice, Meshes meshes, Draw& draw) {
  draw.plane = dice.chance(0.5);
  draw.cells = any_cells(dice, draw.plane);
  draw.lower_kind = draw.cells;
  const bool may_be_refined = draw.plane || draw.cells == "hexa8" || draw.cells == "tetra4";
  const bool refined = dice.chance(draw.plane ? 0.3 : 0.1);
  draw.refine = refined && may_be_refined && meshes == Meshes::any ? 2 : 1;
  if (dice.chance(0.5)) {
    draw.lower_cells = dice.whole(15, 27);
    draw.lower_across = draw.plane ? 1 : dice.whole(1, 2);
    if (dice.chance(0.4))
      draw.lower_kind = any_cells(dice, draw.plane);
  }
  draw.slave_above = dice.chance(0.5);
}

void draw_mesh(Dice& dice, Meshes meshes, Draw& draw) {
  if (draw.integration == Integration::mortar)
    draw_any_cells(dice, meshes, draw);
  else
    draw_linear_cells(dice, meshes, draw);
  if (dice.chance(0.3))
    draw.shift = dice.uniform(-0.03, 0.03);
  const double place = dice.uniform(0, 1);
  if (place < 0.2)
    draw.gap = dice.magnitude(1e-6, 5e-3);
  else if (place < 0.4)
    draw.gap = -dice.magnitude(1e-7, 3e-4);
  draw.poisson = dice.chance(0.5) ? 0.3 : 0;
}

/// Nodal methods know no mortar.
void draw_mortar_method(Dice& dice, Draw& draw) {
  draw.contact = dice.one_of({"augmented_lagrangian", "augmented_lagrangian", "augmented_lagrangian",
                              "augmented_lagrangian", "penalty", "exponential"});
  if (draw.contact != "exponential")
    return;
  const double pressure = dice.magnitude(1e6, 1e8);
  draw.numbers = fmt::format(", coefficients: {{pressure: {:.3g}, clearance: {:.3g}}}", pressure,
                             dice.magnitude(1e-6, 1e-4));
}

void draw_contact(Dice& dice, Draw& draw) {
  draw.friction = dice.chance(0.15) ? 0 : dice.uniform(0, 1.5);
  if (draw.integration == Integration::mortar) {
    draw_mortar_method(dice, draw);
    return;
  }
  const auto method = dice.one_of({"augmented_lagrangian", "augmented_lagrangian", "augmented_lagrangian",
                                   "penalty", "nodal_lagrange", "nodal_penalty", "nodal_pcg"});
  draw.contact = method;
  if (method == "nodal_pcg")
    draw.friction = 0;
}

std::string iterations(Dice& dice, const Draw& draw) {
  if (draw.contact.starts_with("nodal_"))
    return "";
  const auto geometry = level(dice);
  const auto friction = level(dice);
  return fmt::format("iterate: {{geometry: {}, friction: {}, status: {}}}", geometry, friction, level(dice));
}

void draw_time(Dice& dice, Meshes meshes, Draw& draw) {
  draw.step = dice.magnitude(1e-5, 2e-3);
  draw.steps = meshes == Meshes::any ? dice.whole(30, 60) : dice.whole(10, 20);
  draw.scheme =
      dice.one_of({"hht", "hht", "hht", "newmark", "generalized_alpha", "modified_average_acceleration"});
  if (draw.scheme == "hht" || draw.scheme == "modified_average_acceleration")
    draw.time = fmt::format(", alpha: {:.3f}", dice.uniform(-0.3, -0.01));
  if (draw.scheme == "generalized_alpha")
    draw.time = fmt::format(", spectral_radius: {:.3f}", dice.uniform(0, 0.95));
  draw.load = dice.magnitude(0.01, 10);
}

/// What contact surfaces weigh, and Moreau's velocities, which take no springs.
void draw_safety(Dice& dice, Draw& draw) {
  draw.redistributed = dice.chance(0.5);
  const bool jumps = dice.chance(0.5);
  const bool in_the_middle = dice.chance(0.5);
  const bool no_springs = draw.contact == "augmented_lagrangian" || draw.contact == "nodal_pcg" ||
                          (draw.friction == 0 && draw.contact == "nodal_lagrange");
  if (jumps && no_springs) {
    draw.scheme = "moreau_jean";
    draw.time = in_the_middle ? "" : fmt::format(", theta: {:.3f}", dice.uniform(0.5, 0.7));
  }
  if (draw.redistributed)
    draw.time += ", contact_mass: redistributed";
  else if (draw.scheme == "moreau_jean")
    draw.time += ", contact_mass: consistent";
}

/// Of one beam.
struct Grid {
  std::string kind;
  int along = 0;
  int across = 1;
};

std::string body(const Draw& draw, const std::string& name, double left, double bottom, const Grid& grid,
                 const std::string& groups) {
  const double top = bottom + 0.1;
  if (draw.plane)
    return fmt::format("    - {{name: {}, rectangle: {{from: [{:.6g}, {:.9g}], to: [{:.6g}, {:.9g}]}}, "
                       "divisions: [{}, 2], cells: {}, {}}}\n",
                       name, left, bottom, left + 1, top, grid.along, grid.kind, groups);
  return fmt::format("    - {{name: {}, box: {{from: [{:.6g}, {:.9g}, 0], to: [{:.6g}, {:.9g}, 0.1]}}, "
                     "divisions: [{}, 2, {}], cells: {}, {}}}\n",
                     name, left, bottom, left + 1, top, grid.along, grid.across, grid.kind, groups);
}

std::string mesh_of(const Draw& draw) {
  const auto* loaded = draw.plane ? "points: {right_top: loaded}" : "edges: {right_top: loaded}";
  return fmt::format("mesh:\n  generate:\n{}{}  refine: {}\n",
                     body(draw, "upper", 0, 0, {draw.cells, draw.upper_cells},
                          fmt::format("sides: {{left: upper_clamp, bottom: upper_face}}, {}", loaded)),
                     body(draw, "lower", draw.shift, -0.1 - draw.gap,
                          {draw.lower_kind, draw.lower_cells, draw.lower_across},
                          "sides: {left: lower_clamp, top: lower_face}"),
                     draw.refine);
}

std::string deck_of(const Draw& draw, const std::string& title, const std::string& iterate) {
  const auto* fixed = draw.plane ? "[x, y]" : "[x, y, z]";
  const auto* z = draw.plane ? "" : ", 0.05";
  const auto* slave = draw.slave_above ? "upper" : "lower";
  const auto* master = draw.slave_above ? "lower" : "upper";
  return fmt::format(
      R"(title: {}
{}physics: {}
materials: {{steel: {{young: 200e9, poisson: {}, density: 7800}}}}
supports: [{{on: upper_clamp, fix: {}}}, {{on: lower_clamp, fix: {}}}]
loads: [{{{}: {{on: loaded, y: {:.6g}}}}}]
contact:
  interface: {{master: {}_face, slave: {}_face, friction: {:.4f}, method: {}, exclude_nodes: [{}_clamp]{}{}{}{}}}
time: {{scheme: {}{}, step: {:.6g}, end: {:.9g}}}
probes: {{upper: {{point: [1, 0.1{}]}}, lower: {{point: [{:.6g}, {:.6g}{}]}}}}
checkpoint: {{last: false}}
)",
      title, mesh_of(draw), draw.plane ? "plane_stress" : "solid", draw.poisson, fixed, fixed,
      draw.plane ? "nodal_force" : "line_force", -1e7 * draw.load, master, slave, draw.friction, draw.contact,
      slave, draw.integration == Integration::mortar ? by_mortar : on_nodes, draw.numbers,
      iterate.empty() ? "" : ", ", iterate, draw.scheme, draw.time, draw.step, draw.steps * draw.step, z,
      1 + draw.shift, -0.1 - draw.gap, z);
}

std::string words_of(const Draw& draw, const std::string& iterate) {
  std::string words =
      fmt::format("{} {}/{}", draw.cells, draw.upper_cells * draw.refine, draw.lower_cells * draw.refine);
  if (draw.lower_across > 1)
    words += fmt::format(" × {}", draw.lower_across * draw.refine);
  if (draw.lower_kind != draw.cells)
    words += " " + draw.lower_kind;
  if (draw.slave_above)
    words += ", slave above";
  if (draw.shift != 0)
    words += fmt::format(", shifted {:.3f}", draw.shift);
  if (draw.gap != 0)
    words += fmt::format(", {} {:.1e}", draw.gap > 0 ? "gap" : "overlap", std::abs(draw.gap));
  words += fmt::format(", ν {}, load × {:.3g}, μ {:.2f}, {}", draw.poisson, draw.load, draw.friction,
                       draw.contact);
  if (!iterate.empty())
    words += fmt::format(" {}", std::string_view(iterate).substr(iterate.find('{')));
  return words + fmt::format(", {}{}, {} × {:.2e} s", draw.scheme, draw.time, draw.steps, draw.step);
}

bool matches(const Draw& draw) {
  return draw.lower_cells == draw.upper_cells && draw.lower_across == 1 && draw.lower_kind == draw.cells &&
         draw.shift == 0;
}

Variant variant(std::uint32_t seed, int number, Meshes meshes, Integration integration) {
  Dice dice(seed, number);
  Draw draw;
  draw.integration = integration;
  draw_mesh(dice, meshes, draw);
  draw_contact(dice, draw);
  const auto iterate = iterations(dice, draw);
  draw_time(dice, meshes, draw);
  draw_safety(dice, draw);
  return {number,
          draw.cells,
          draw.scheme,
          draw.contact,
          words_of(draw, iterate),
          draw.refine > 1,
          draw.gap < 0,
          draw.redistributed,
          matches(draw),
          draw.scheme == "moreau_jean",
          draw.steps,
          deck_of(draw, fmt::format("two beams, variant {}", number), iterate)};
}

study::Study study_of(const Variant& variant, const std::vector<deck::Setting>& changes = {}) {
  return deck::parse_deck(variant.deck, fmt::format("{}.yaml", variant.number), changes).runs.front();
}

/// Runs until it has tried that many times the steps it has.
run::RunResult run_patiently(const Variant& variant, const study::Study& study,
                             const std::filesystem::path& folder, bool& warned) {
  constexpr int patience = 10;
  int attempts = 0;
  run::Watch watch;
  watch.progress = [&](const run::Progress&) { ++attempts; };
  watch.warn = [&](const std::string& text) { warned = warned || text.find("energy gained") != text.npos; };
  watch.stop = [&] { return attempts > patience * variant.steps; };
  auto result = run::run_study(study, folder, watch);
  if (result.status == run::Status::interrupted)
    result.message = fmt::format("given up after {} attempts, {}", attempts, result.message);
  return result;
}

void note_energy(const std::filesystem::path& file, Survival& survival) {
  const auto& energy = survival.result.energy;
  if (energy.largest == 0)
    return;
  const auto table = results::read_csv(file);
  const auto impact = static_cast<std::size_t>(table.column("impact"));
  for (const auto& row : table.rows)
    survival.contact_gain = std::max(survival.contact_gain, -row[impact] / energy.largest);
  survival.gain = energy.gain / energy.largest;
  survival.balance = energy.largest_balance / energy.largest;
}

} // namespace

std::vector<Variant> variants(std::uint32_t seed, int first, int count, Meshes meshes,
                              Integration integration) {
  std::vector<Variant> all;
  for (int number = first; number < first + count; ++number)
    all.push_back(variant(seed, number, meshes, integration));
  return all;
}

Variant by_nodes(const Variant& variant) {
  auto changed = variant;
  if (const auto place = changed.deck.find(by_mortar); place != std::string::npos)
    changed.deck.replace(place, by_mortar.size(), on_nodes);
  return changed;
}

Survival survive(const Variant& variant) {
  const test::ScratchFolder folder;
  Survival survival;
  try {
    survival.result = run_patiently(variant, study_of(variant), folder / "run", survival.warned);
    if (survival.result.status != run::Status::complete)
      survival.failure = survival.result.message;
    note_energy(folder / "run/energy.csv", survival);
  } catch (const std::exception& error) {
    survival.failure = error.what();
  }
  return survival;
}

SolverComparison compare_solvers(const Variant& variant) {
  std::array<results::Table, 2> histories;
  std::array<int, 2> steps{};
  for (std::size_t i = 0; i < histories.size(); ++i) {
    const test::ScratchFolder folder;
    const auto study =
        study_of(variant, {{"solver", i == 0 ? "condensed" : "full"}, {"newton.residual", "1e-11"}});
    bool warned = false;
    const auto result = run_patiently(variant, study, folder / "run", warned);
    if (result.status != run::Status::complete)
      return {};
    steps[i] = result.steps;
    histories[i] = results::read_csv(folder / "run/probes.csv");
  }
  const auto same_instant = [](const auto& a, const auto& b) { return a.front() == b.front(); };
  const bool same_steps = std::ranges::equal(histories[0].rows, histories[1].rows, same_instant);
  double largest = 0;
  double difference = 0;
  for (const auto& whole : histories[1].rows) {
    const auto condensed =
        std::ranges::find(histories[0].rows, whole.front(), [](const auto& row) { return row.front(); });
    for (std::size_t i = 1; i < whole.size(); ++i) {
      largest = std::max(largest, std::abs(whole[i]));
      if (condensed != histories[0].rows.end())
        difference = std::max(difference, std::abs((*condensed)[i] - whole[i]));
    }
  }
  return {difference / largest, steps[0], steps[1], same_steps};
}

} // namespace rubato::verification
