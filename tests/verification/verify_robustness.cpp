// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>

#include "verification/robustness.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <span>

namespace rubato::verification {
namespace {

constexpr std::uint32_t seed = 140;
constexpr int count = 500;
/// Every so many variants, those on unrefined meshes, are solved whole as well; conjugate gradients cannot
/// be.
constexpr int compared = 5;
/// Beyond it the solvers went different ways.
constexpr double same_answer = 1e-6;

struct Entry {
  Variant variant;
  Survival survival;
  SolverComparison solvers = {};         ///< of some only
  std::optional<Survival> by_nodes = {}; ///< of mortar contact, of some only
};

using Entries = std::vector<Entry>;
using Key = std::function<std::string(const Variant&)>;

std::vector<Entry> run_all(const std::filesystem::path& decks) {
  std::filesystem::remove_all(decks);
  std::filesystem::create_directories(decks);
  Entries entries;
  for (const auto& variant : variants(seed, 0, count)) {
    Entry entry{variant, survive(variant)};
    if (!entry.survival.finished())
      std::ofstream(decks / fmt::format("{:03}.yaml", variant.number)) << variant.deck;
    else if (variant.number % compared == 0 && !variant.refined && variant.method != "nodal_pcg")
      entry.solvers = compare_solvers(variant);
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::string share(std::ptrdiff_t part, std::ptrdiff_t whole) {
  return whole == 0 ? ""
                    : fmt::format("{} ({:.1f} %)", part,
                                  100. * static_cast<double>(part) / static_cast<double>(whole));
}

std::map<std::string, Entries> sorted_by(const Entries& entries, const Key& key) {
  std::map<std::string, Entries> sorted;
  for (const auto& entry : entries)
    sorted[key(entry.variant)].push_back(entry);
  return sorted;
}

void write_finished(Page& page, const Entries& entries) {
  const auto row = [&](const std::string& name, const Entries& of) {
    const auto finished = std::ranges::count_if(of, [](const Entry& e) { return e.survival.finished(); });
    int steps = 0;
    int cuts = 0;
    int iterations = 0;
    double seconds = 0;
    for (const auto& [variant, survival, solvers, by_nodes] : of) {
      steps += survival.result.steps;
      cuts += survival.result.cuts;
      iterations += survival.result.iterations;
      seconds += survival.result.setup_seconds + survival.result.loop_seconds;
    }
    page.row({name, std::to_string(of.size()), share(finished, std::ssize(of)), std::to_string(steps),
              std::to_string(cuts),
              fmt::format("{:.1f}", iterations / std::max(1., static_cast<double>(steps))),
              fmt::format("{:.0f}", seconds)});
  };
  page.table({"", "variants", "finished", "steps", "cuts", "iterations a step", "seconds"});
  row("all", entries);
  for (const auto& key : {Key(&Variant::method), Key(&Variant::scheme), Key(&Variant::cells)})
    for (const auto& [name, of] : sorted_by(entries, key))
      row(name, of);
}

/// Of bodies that do not overlap at the start.
void write_gains(Page& page, const Entries& entries) {
  page.table({"scheme", "contact mass", "variants", "gain kept", "by contact > 1 %", "largest by contact",
              "soon given up"});
  Entries apart;
  std::ranges::copy_if(entries, std::back_inserter(apart),
                       [](const Entry& e) { return !e.variant.overlaps; });
  const auto key = [](const Variant& v) { return fmt::format("{} {}", v.scheme, v.massless); };
  for (const auto& [name, of] : sorted_by(apart, key)) {
    const auto kept = std::ranges::count_if(of, [](const Entry& e) { return e.survival.keeps_gain(); });
    const auto by_contact =
        std::ranges::count_if(of, [](const Entry& e) { return e.survival.contact_gain > 0.01; });
    const auto passing = std::ranges::count_if(
        of, [](const Entry& e) { return !e.survival.keeps_gain() && e.survival.gain > 0.01; });
    double largest = 0;
    for (const auto& entry : of)
      largest = std::max(largest, entry.survival.contact_gain);
    page.row({of.front().variant.scheme, of.front().variant.massless ? "redistributed" : "consistent",
              std::to_string(of.size()), share(kept, std::ssize(of)), share(by_contact, std::ssize(of)),
              fmt::format("{:.1e}", largest), share(passing, std::ssize(of))});
  }
}

void write_list(Page& page, const Entries& entries, const std::function<bool(const Entry&)>& wanted,
                const std::string& heading, const std::function<std::string(const Entry&)>& told) {
  page.table({"variant", "drawn", heading});
  for (const auto& entry : entries)
    if (wanted(entry))
      page.row({std::to_string(entry.variant.number), entry.variant.words, told(entry)});
}

std::vector<Entry> run_all_by_mortar(const std::filesystem::path& decks) {
  std::filesystem::remove_all(decks);
  std::filesystem::create_directories(decks);
  Entries entries;
  for (const auto& variant : variants(seed, 0, count, Meshes::any, Integration::mortar)) {
    Entry entry{variant, survive(variant)};
    if (!entry.survival.finished())
      std::ofstream(decks / fmt::format("{:03}.yaml", variant.number)) << variant.deck;
    if (variant.number % compared == 0)
      entry.by_nodes = survive(by_nodes(variant));
    entries.push_back(std::move(entry));
  }
  return entries;
}

double iterations_a_step(std::span<const run::RunResult> results) {
  double iterations = 0;
  double steps = 0;
  for (const auto& result : results) {
    iterations += result.iterations;
    steps += result.steps;
  }
  return iterations / std::max(1., steps);
}

/// Of the variants that were run both ways.
void write_against_nodes(Page& page, const Entries& entries) {
  page.table({"meshes", "variants", "finished by mortar", "by nodes", "iterations a step by mortar",
              "by nodes", "ratio"});
  const auto row = [&](const std::string& name, const std::function<bool(const Variant&)>& wanted) {
    std::vector<run::RunResult> mortar;
    std::vector<run::RunResult> nodes;
    std::ptrdiff_t finished = 0;
    std::ptrdiff_t finished_by_nodes = 0;
    for (const auto& entry : entries)
      if (entry.by_nodes && wanted(entry.variant)) {
        mortar.push_back(entry.survival.result);
        nodes.push_back(entry.by_nodes->result);
        finished += entry.survival.finished() ? 1 : 0;
        finished_by_nodes += entry.by_nodes->finished() ? 1 : 0;
      }
    const double by_mortar = iterations_a_step(mortar);
    const double by_nodes = iterations_a_step(nodes);
    page.row({name, std::to_string(mortar.size()), share(finished, std::ssize(mortar)),
              share(finished_by_nodes, std::ssize(nodes)), fmt::format("{:.1f}", by_mortar),
              fmt::format("{:.1f}", by_nodes), fmt::format("{:.2f}", by_mortar / by_nodes)});
  };
  row("all", [](const Variant&) { return true; });
  row("matching", [](const Variant& v) { return v.matching; });
  row("not matching", [](const Variant& v) { return !v.matching; });
}

void write_balance(Page& page, const Entries& entries) {
  double balance = 0;
  for (const auto& entry : entries)
    balance = std::max(balance, entry.survival.balance);
  page.paragraph(
      fmt::format("The energy ledger closes within {:.1e} of the largest energy in all of them.", balance));
}

void write_energy(Page& page, const Entries& entries) {
  page.paragraph(
      "## Energy\n\nVariants whose bodies do not overlap at the start (an overlap is energy that is put "
      "in). Kept: a gain above 1 % that the run "
      "[warns of](../theory/energy.md#gains); soon given up: a gain above 1 % that it does not warn of.");
  write_gains(page, entries);
}

void write_failures(Page& page, const Entries& entries, const std::string& folder) {
  page.paragraph(
      fmt::format("## Failures\n\nTheir decks are left in `verification/{}` of the build folder.", folder));
  write_list(
      page, entries, [](const Entry& e) { return !e.survival.finished(); }, "report",
      [](const Entry& e) { return e.survival.failure; });
}

} // namespace

void write_robustness(const std::filesystem::path& folder) {
  const std::filesystem::path decks(RUBATO_RUNS_DIR "/robustness");
  const auto entries = run_all(decks);
  Page page(folder / "robustness.md", "Robustness: random variants of two beams");
  page.paragraph(fmt::format("{} variants of SDNL140's two beams, drawn from seed {}: steps from 1e-5 to "
                             "2e-3 s (30 to 60 of them), μ from 0 "
                             "to 1.5, a hundredth to ten times the load, QUAD4, HEXA8 and TETRA4 cells, "
                             "refined or not, meshes that match or "
                             "do not, shifted or not, bodies that touch, gape or overlap at the start, every "
                             "scheme, every method, every "
                             "level by Newton or by a loop. Nothing is helped along: coefficients, "
                             "tolerances and cuts are the defaults.",
                             count, seed));
  write_finished(page, entries);
  write_balance(page, entries);
  write_energy(page, entries);
  const auto compared_ones =
      std::ranges::count_if(entries, [](const Entry& e) { return e.solvers.difference >= 0; });
  double worst = 0;
  double worst_of_same_steps = 0;
  for (const auto& entry : entries) {
    worst = std::max(worst, entry.solvers.difference);
    if (entry.solvers.same_steps)
      worst_of_same_steps = std::max(worst_of_same_steps, entry.solvers.difference);
  }
  page.paragraph(fmt::format("## Condensed against whole\n\n{} variants on unrefined meshes were solved both "
                             "ways to a residual of 1e-11. "
                             "Largest difference of the tips' displacements, over the largest one: {:.1e} "
                             "where both took the same steps, "
                             "{:.1e} where one cut a step that the other took whole: then they solve "
                             "different problems in time, and what "
                             "hits and rubs takes the difference further. Those beyond {:.0e}:",
                             compared_ones, worst_of_same_steps, worst, same_answer));
  write_list(
      page, entries, [](const Entry& e) { return e.solvers.difference > same_answer; },
      "difference (steps condensed, whole)",
      [](const Entry& e) {
        return fmt::format("{:.1e} ({}, {})", e.solvers.difference, e.solvers.steps_condensed,
                           e.solvers.steps_whole);
      });

  page.paragraph("## Gains kept by `moreau_jean`");
  write_list(
      page, entries,
      [](const Entry& e) { return e.variant.safe && !e.variant.overlaps && e.survival.keeps_gain(); },
      "largest gain, by contact",
      [](const Entry& e) { return fmt::format("{:.1e}, {:.1e}", e.survival.gain, e.survival.contact_gain); });

  write_failures(page, entries, "robustness");
}

void write_mortar_robustness(const std::filesystem::path& folder) {
  const auto entries = run_all_by_mortar(RUBATO_RUNS_DIR "/mortar_robustness");
  Page page(folder / "mortar_robustness.md", "Robustness: random variants of two beams with mortar contact");
  page.paragraph(fmt::format(
      "{} variants of SDNL140's two beams with `integration: mortar`, drawn from seed {} as for "
      "[nodes](robustness.md), but with cells of every kind, meshes that do not match in half of them (in "
      "number, across, or in their kind), either beam the slave, and every method that takes mortar. "
      "Coefficients, tolerances and cuts are the defaults.",
      count, seed));
  write_finished(page, entries);
  write_balance(page, entries);
  page.paragraph(fmt::format("## Against nodes\n\nEvery variant whose number is a multiple of {} also ran "
                             "with `integration: nodes`, all else being the same.",
                             compared));
  write_against_nodes(page, entries);
  write_energy(page, entries);
  write_failures(page, entries, "mortar_robustness");
}

} // namespace rubato::verification
