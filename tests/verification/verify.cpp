// SPDX-License-Identifier: LGPL-3.0-or-later
/// verify FOLDER [page…]: makes the runs of the pages (all when none is named) and writes FOLDER/<page>.md.
/// A page sdnl140_<letters>, as in sdnl140_f, has the runs of these modelings only.
#include "verification/verify.hpp"

#include "rubato/core/transformed.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {

Page::Page(const std::filesystem::path& file, const std::string& title) : file_(file) {
  line("<!-- SPDX-License-Identifier: LGPL-3.0-or-later -->");
  line(fmt::format("# {}\n", title));
  line("This page is written by the target `verify` from runs of the program as built; seconds are processor "
       "time on the machine that ran it.\n");
}

void Page::paragraph(const std::string& text) {
  line("\n" + text + "\n");
}

void Page::table(const std::vector<std::string>& columns) {
  row(columns);
  row(std::vector<std::string>(columns.size(), "---"));
}

void Page::row(const std::vector<std::string>& values) {
  line(fmt::format("| {} |", fmt::join(values, " | ")));
}

void Page::line(const std::string& text) {
  file_ << text << '\n' << std::flush;
  if (!file_)
    throw std::runtime_error("a page cannot be written");
}

std::string outcome_of(const run::RunResult& result) {
  return result.status == run::Status::complete ? "complete" : result.message;
}

std::string seconds_of(const run::RunResult& result) {
  return fmt::format("{:.2f}", result.setup_seconds + result.loop_seconds);
}

} // namespace rubato::verification

namespace {

struct Entry {
  std::string_view page;
  void (*write)(const std::filesystem::path&);
};

constexpr std::array<Entry, 26> entries{
    {{"v1", rubato::verification::write_bar_on_wall},
     {"v2", rubato::verification::write_dropped_bar},
     {"v3", rubato::verification::write_contact_patch},
     {"v4", rubato::verification::write_hertz},
     {"v5", rubato::verification::write_mindlin},
     {"v6", rubato::verification::write_incline},
     {"v7", rubato::verification::write_slider},
     {"v8", rubato::verification::write_sphere_impact},
     {"v9", rubato::verification::write_signorini},
     {"v10", rubato::verification::write_rod_on_rod},
     {"v11", rubato::verification::write_free_beam},
     {"modes", rubato::verification::write_modes},
     {"sdnl140", rubato::verification::write_sdnl140},
     {"convergence", rubato::verification::write_convergence},
     {"explicit", rubato::verification::write_explicit},
     {"condensed", rubato::verification::write_condensed},
     {"defaults", rubato::verification::write_defaults},
     {"robustness", rubato::verification::write_robustness},
     {"solids_robustness", rubato::verification::write_solids_robustness},
     {"second_way", rubato::verification::write_second_way},
     {"relations", rubato::verification::write_relations},
     {"heat", rubato::verification::write_heat},
     {"solids", rubato::verification::write_solids},
     {"bulk", rubato::verification::write_bulk},
     {"mortar", rubato::verification::write_mortar},
     {"mortar_robustness", rubato::verification::write_mortar_robustness}}};

constexpr std::string_view modelings_prefix = "sdnl140_";

/// What is wrong with the name of a page; nothing for a good one.
std::string fault_of(const std::string& name) {
  if (name.starts_with(modelings_prefix) || std::ranges::find(entries, name, &Entry::page) != entries.end())
    return "";
  const auto pages = rubato::transformed<std::string_view>(entries, &Entry::page);
  return fmt::format("{} is no page; there are {}, {}<letters>", name, fmt::join(pages, ", "),
                     modelings_prefix);
}

int run(int argc, char** argv) {
  CLI::App app("Makes the runs of the verification's pages and writes them.");
  std::filesystem::path folder;
  std::vector<std::string> pages;
  app.add_option("folder", folder, "where FOLDER/<page>.md go")->required();
  app.add_option("pages", pages, "which; all when none is named")->check(CLI::Validator(&fault_of, "PAGE"));
  CLI11_PARSE(app, argc, argv);
  std::filesystem::create_directories(folder);
  for (const auto& entry : entries)
    if (pages.empty() || std::ranges::find(pages, entry.page) != pages.end()) {
      std::puts(fmt::format("{}.md", entry.page).c_str());
      std::fflush(stdout);
      entry.write(folder);
    }
  for (const auto& page : pages)
    if (page.starts_with(modelings_prefix))
      rubato::verification::write_sdnl140_of(folder, page.substr(modelings_prefix.size()));
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fputs(fmt::format("verify: {}\n", error.what()).c_str(), stderr);
    return 1;
  }
}
