// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>

#include "verification/solids_sweep.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

namespace rubato::verification {
namespace {

constexpr std::uint32_t solids_seed = 2200;
constexpr int solids_count = 200;

struct SolidEntry {
  SolidVariant variant;
  SolidSurvival survival;
};
using SolidEntries = std::vector<SolidEntry>;

SolidEntries run_solids(const std::filesystem::path& decks) {
  std::filesystem::remove_all(decks);
  std::filesystem::create_directories(decks);
  SolidEntries entries;
  for (const auto& variant : solid_variants(solids_seed, 0, solids_count)) {
    entries.push_back({variant, survive(variant)});
    if (!entries.back().survival.finished())
      std::ofstream(decks / fmt::format("{:03}.yaml", variant.number)) << variant.deck;
  }
  return entries;
}

double a_step(double count, int steps) {
  return count / std::max(1, steps);
}

void write_family(Page& page, const std::string& name, const SolidEntries& of) {
  int steps = 0, wanted = 0, cuts = 0;
  double iterations = 0, bulk = 0, factorisations = 0, seconds = 0;
  for (const auto& [variant, survival] : of) {
    wanted += variant.steps;
    steps += survival.result.steps;
    cuts += survival.result.cuts;
    iterations += survival.result.iterations;
    bulk += survival.bulk_iterations;
    factorisations += survival.factorisations;
    seconds += survival.result.setup_seconds + survival.result.loop_seconds;
  }
  const auto finished = std::ranges::count_if(of, [](const auto& e) { return e.survival.finished(); });
  const auto uncut = std::ranges::count_if(
      of, [](const auto& e) { return e.survival.finished() && e.survival.result.cuts == 0; });
  const auto yielded = std::ranges::count_if(of, [](const auto& e) { return e.survival.plastic > 1e-3; });
  page.row({name, std::to_string(of.size()), std::to_string(finished), std::to_string(uncut),
            std::to_string(yielded), std::to_string(wanted), std::to_string(steps), std::to_string(cuts),
            fmt::format("{:.1f}", a_step(iterations, steps)), fmt::format("{:.1f}", a_step(bulk, steps)),
            fmt::format("{:.2f}", a_step(factorisations, steps)), fmt::format("{:.0f}", seconds)});
}

void write_families(Page& page, const SolidEntries& entries) {
  page.table({"", "variants", "finished", "without a cut", "yielded", "steps wanted", "made", "cuts",
              "contact iterations a step", "motions of the bodies a step", "factorisations a step",
              "seconds"});
  write_family(page, "all", entries);
  std::set<std::string> families;
  for (const auto& entry : entries)
    families.insert(entry.variant.family);
  for (const auto& family : families) {
    SolidEntries of;
    std::ranges::copy_if(entries, std::back_inserter(of),
                         [&](const auto& e) { return e.variant.family == family; });
    write_family(page, family, of);
  }
}

double largest(const SolidEntries& entries, double SolidSurvival::*of) {
  double most = 0;
  for (const auto& entry : entries)
    most = std::max(most, entry.survival.*of);
  return most;
}

void write_ends(Page& page, const SolidEntries& entries) {
  page.paragraph(fmt::format(
      "## What holds at the end\n\nThe energy ledger closes within {:.1e} of the largest energy in all of "
      "them. Exact contact leaves at most {:.1e} of the size of the mesh as penetration, and nowhere pulls "
      "by more than {:.1e} of the largest pressure.",
      largest(entries, &SolidSurvival::balance), largest(entries, &SolidSurvival::penetration),
      largest(entries, &SolidSurvival::tension)));
}

void write_solid_list(Page& page, const SolidEntries& entries,
                      const std::function<bool(const SolidEntry&)>& wanted, const std::string& heading,
                      const std::function<std::string(const SolidEntry&)>& told) {
  page.table({"variant", "family", "drawn", heading});
  for (const auto& entry : entries)
    if (wanted(entry))
      page.row(
          {std::to_string(entry.variant.number), entry.variant.family, entry.variant.words, told(entry)});
}

} // namespace

void write_solids_robustness(const std::filesystem::path& folder) {
  const auto entries = run_solids(RUBATO_RUNS_DIR "/solids_robustness");
  Page page(folder / "solids_robustness.md", "Robustness: random variants of bodies that yield and stretch");
  page.paragraph(fmt::format(
      "{} variants, drawn from seed {}: two beams as in SDNL140 of plastic metal (every hardening law), and "
      "of rubber, metal and elastic material at finite strain; blocks of rubber and metal that plates "
      "squeeze by 10 to 50 % and move sideways and back; seals in grooves, rings between plates, press fits "
      "that yield, snap hooks and balls that go through rings. Loads and steps over a decade or two, μ from "
      "0 to 0.8, QUAD4, QUAD8, TRIA6, HEXA8, HEXA20, PENTA6, TETRA10, static and dynamic schemes, contact by "
      "every method with the default most often. Nothing is helped along: decks have neither `newton` nor "
      "coefficients, and cuts are those of the default `on_failure`. Iterations and factorisations count "
      "those of attempts that were cut.",
      solids_count, solids_seed));
  write_families(page, entries);
  write_ends(page, entries);
  page.paragraph("## Cut more than three times");
  write_solid_list(
      page, entries, [](const auto& e) { return e.survival.finished() && e.survival.result.cuts > 3; },
      "cuts (steps wanted, made)",
      [](const auto& e) {
        return fmt::format("{} ({}, {})", e.survival.result.cuts, e.variant.steps, e.survival.result.steps);
      });
  page.paragraph(
      "## Failures\n\nTheir decks are left in `verification/solids_robustness` of the build folder.");
  write_solid_list(
      page, entries, [](const auto& e) { return !e.survival.finished(); }, "report",
      [](const auto& e) { return e.survival.failure; });
}

} // namespace rubato::verification
