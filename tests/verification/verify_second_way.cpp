// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "verification/second_way_page.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>

namespace rubato::verification {
namespace {

constexpr std::uint32_t way_seed = 2900;
constexpr int way_count = 312;

std::vector<WayEntry> run_ways(const std::filesystem::path& decks) {
  std::filesystem::remove_all(decks);
  std::filesystem::create_directories(decks);
  std::vector<WayEntry> entries;
  for (auto& study : way_studies(way_seed, 0, way_count)) {
    std::ofstream(decks / fmt::format("{:03}.yaml", study.number)) << study.deck;
    auto comparison = compare_ways(study);
    entries.push_back({std::move(study), std::move(comparison)});
  }
  return entries;
}

bool remains(const Comparison& comparison) {
  return comparison.failure.empty() && comparison.large() && !comparison.explained();
}

/// Numbers of rows that compare a way, or all of them.
struct WayCounts {
  int compared = 0, close = 0, explained = 0, remaining = 0, silent = 0, failed = 0;

  void note(const Comparison& comparison) {
    ++compared;
    failed += comparison.failure.empty() ? 0 : 1;
    close += comparison.failure.empty() && !comparison.large() ? 1 : 0;
    explained += comparison.failure.empty() && comparison.large() && comparison.explained() ? 1 : 0;
    remaining += remains(comparison) ? 1 : 0;
    silent += remains(comparison) && !comparison.warned ? 1 : 0;
  }
};

void write_count_row(Page& page, const std::string& name, const WayCounts& counts) {
  page.row({name, std::to_string(counts.compared), std::to_string(counts.close),
            std::to_string(counts.explained), std::to_string(counts.remaining), std::to_string(counts.silent),
            std::to_string(counts.failed)});
}

WayCounts counts_of(const std::vector<WayEntry>& entries,
                    const std::function<bool(const WayEntry&, const Comparison&)>& counted) {
  WayCounts counts;
  for (const auto& entry : entries)
    for (const auto& comparison : entry.comparison.ways)
      if (counted(entry, comparison))
        counts.note(comparison);
  return counts;
}

const std::vector<std::string> count_columns{"",           "comparisons",
                                             "within 2 %", "explained by refinement",
                                             "remaining",  "remaining without a warning",
                                             "run failed"};

void write_counts(Page& page, const std::vector<WayEntry>& entries) {
  std::set<std::string> ways, families;
  for (const auto& entry : entries) {
    families.insert(entry.study.family);
    for (const auto& comparison : entry.comparison.ways)
      ways.insert(comparison.way);
  }
  page.paragraph("## By way");
  page.table(count_columns);
  write_count_row(page, "all", counts_of(entries, [](const auto&, const auto&) { return true; }));
  for (const auto& way : ways)
    write_count_row(page, way, counts_of(entries, [&](const auto&, const auto& comparison) {
                      return comparison.way == way;
                    }));
  page.paragraph("## By family");
  page.table(count_columns);
  for (const auto& family : families)
    write_count_row(page, family, counts_of(entries, [&](const auto& entry, const auto&) {
                      return entry.study.family == family;
                    }));
}

/// The first sentence of a warning, without the name of the run.
std::string shortened(const std::string& warning) {
  constexpr std::size_t most = 110;
  const auto begin = warning.starts_with("run: ") ? std::size_t{5} : std::size_t{0};
  auto text = warning.substr(begin, warning.find(';', begin) - begin);
  if (text.size() > most) {
    const auto end = text.rfind(' ', most);
    text = text.substr(0, end) + " …";
  }
  return text;
}

std::string size_or_nothing(double size) {
  return size < 0 ? "" : fmt::format("{:.3f}", size);
}

void write_remaining(Page& page, const std::vector<WayEntry>& entries) {
  page.paragraph(
      "## Differences above 2 % that refinement does not explain\n\nThe quantity is the one that differs "
      "most at level 1, with the quarter of the run in brackets. The cause is a kind that was found in "
      "the study it names ([notes](notes.md#what-the-comparison-sweep-found)); rows were not looked at "
      "one by one.");
  page.table(
      {"study", "family", "drawn", "way", "quantity", "level 1", "level 2", "level 4", "warning", "cause"});
  for (const auto& entry : entries)
    for (const auto& comparison : entry.comparison.ways)
      if (remains(comparison)) {
        const auto cause = cause_of(entry.study, comparison);
        page.row({std::to_string(entry.study.number), entry.study.family, entry.study.words, comparison.way,
                  comparison.coarse.quantity, fmt::format("{:.3f}", comparison.coarse.size),
                  size_or_nothing(comparison.fine), size_or_nothing(comparison.finest),
                  comparison.warned ? shortened(comparison.warnings.front()) : "none",
                  cause.empty() ? "not investigated" : cause});
      }
}

/// Friction takes energy: a defect where it gives any.
void write_given(Page& page, const std::vector<WayEntry>& entries) {
  constexpr double most_given = 1e-3;
  page.paragraph(
      fmt::format("## Friction that gives energy\n\nRuns of level 1 in which the energy of friction falls "
                  "below −{} of the largest energy.",
                  most_given));
  page.table({"study", "family", "drawn", "way", "energy given, over the largest"});
  for (const auto& entry : entries)
    for (const auto& comparison : entry.comparison.ways)
      if (comparison.failure.empty() && comparison.friction_given > most_given)
        page.row({std::to_string(entry.study.number), entry.study.family, entry.study.words, comparison.way,
                  fmt::format("{:.2g}", comparison.friction_given)});
}

void write_failures(Page& page, const std::vector<WayEntry>& entries) {
  page.paragraph("## Runs that did not come to their end");
  page.table({"study", "family", "drawn", "way", "report"});
  for (const auto& entry : entries)
    for (const auto& comparison : entry.comparison.ways)
      if (!comparison.failure.empty())
        page.row({std::to_string(entry.study.number), entry.study.family, entry.study.words, comparison.way,
                  shortened(comparison.failure)});
}

} // namespace

void write_way_entries(Page& page, const std::vector<WayEntry>& entries) {
  int runs = 0;
  double seconds = 0;
  for (const auto& entry : entries) {
    runs += entry.comparison.runs;
    seconds += entry.comparison.seconds;
  }
  page.paragraph(fmt::format(
      "{} studies drawn from seed {}, {} runs, {:.0f} seconds. The families are blocks with edges on a rail, "
      "blocks "
      "with noses, cantilevers that a crest lifts, rings between plates, rollers, wedges, thin linings, "
      "rounded "
      "rubber seals, plates that washers clamp, stacks of three blocks, crowned punches and impacts. They "
      "are "
      "drawn in 2D, axisymmetric and 3D (there of small strain), with all cells but HEXA27, PENTA15, "
      "elastic, plastic and hyperelastic materials, small "
      "and "
      "finite strain, friction 0 to 0.6, three units of length, and `static`, `hht` or the default scheme.",
      entries.size(), way_seed, runs, seconds));
  page.paragraph("Each study runs as its deck says and in these ways:\n\n"
                 "- `nodes`: `integration: nodes` instead of `mortar`;\n"
                 "- `swapped`: slave and master swapped in every zone;\n"
                 "- `half step`: half of `time.step`;\n"
                 "- `full`: `solver: full` (plane studies and every fifth one in 3D);\n"
                 "- `moreau_jean`, `hht`: another time scheme. A phase of a static study lasts 200 transits "
                 "of sound through "
                 "ten units of length;\n"
                 "- `explicit`: `central_difference` with `penalty` and k_n = 100 E over the unit of length "
                 "(dynamic studies with linear cells);\n"
                 "- `refined`: edges and step halved (plane studies of small strain).");
  page.paragraph(
      "Compared are forces and moments of zones, support forces, energies (kinetic, strain, work of loads "
      "and "
      "supports, friction, plastic; impact where both schemes are static) and displacements, as means over "
      "each "
      "quarter of the run. A difference is divided by the largest value of its kind at any instant of both "
      "runs; "
      "moments by the largest force times half the length of the contact surface. A difference above 2 % "
      "counts as "
      "explained by refinement when, between the same two ways with edges and steps halved (level 2), it is "
      "at most "
      "2 % or 0.7 of what it was, or else with edges and steps divided by four (level 4) at most 2 % or 0.49 "
      "of it. `refined` compares levels 1 and 2, then 2 and 3, then 4 and 5. Warnings are those "
      "of the "
      "two runs at level 1; the one on QUAD4 that are too stiff in bending is left out. Decks are left in "
      "`verification/second_way` of the build folder.");
  write_counts(page, entries);
  write_remaining(page, entries);
  write_given(page, entries);
  write_failures(page, entries);
}

void write_second_way(const std::filesystem::path& folder) {
  const auto entries = run_ways(RUBATO_RUNS_DIR "/second_way");
  Page page(folder / "second_way.md", "Comparison sweep: every study in several ways");
  write_way_entries(page, entries);
}

} // namespace rubato::verification
