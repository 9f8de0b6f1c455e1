// SPDX-License-Identifier: LGPL-3.0-or-later
/// verify FOLDER [page…]: makes the runs of the pages (all when none is named) and writes FOLDER/<page>.md.
/// A page sdnl140_<letters>, as in sdnl140_f, has the runs of these modelings only.
#include "verification/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <ranges>
#include <span>
#include <stdexcept>
#include <string_view>

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

constexpr std::array<Entry, 17> entries{{{"v1", rubato::verification::write_bar_on_wall},
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
                                         {"sdnl140", rubato::verification::write_sdnl140},
                                         {"convergence", rubato::verification::write_convergence},
                                         {"explicit", rubato::verification::write_explicit},
                                         {"condensed", rubato::verification::write_condensed},
                                         {"defaults", rubato::verification::write_defaults},
                                         {"robustness", rubato::verification::write_robustness}}};

constexpr std::string_view modelings_prefix = "sdnl140_";

} // namespace

int main(int argc, char** argv) {
  const std::vector<std::string_view> words(argv + 1, argv + argc);
  if (words.empty()) {
    std::fputs(
        "usage: verify FOLDER [v1 … v11 sdnl140 sdnl140_<letters> convergence explicit condensed defaults "
        "robustness]\n",
        stderr);
    return 2;
  }
  try {
    const std::filesystem::path folder(words.front());
    std::filesystem::create_directories(folder);
    for (const auto& entry : entries)
      if (words.size() == 1 || std::ranges::find(words.begin() + 1, words.end(), entry.page) != words.end()) {
        std::puts(fmt::format("{}.md", entry.page).c_str());
        std::fflush(stdout);
        entry.write(folder);
      }
    for (const auto word : words | std::views::drop(1))
      if (word.starts_with(modelings_prefix))
        rubato::verification::write_sdnl140_of(folder, std::string(word.substr(modelings_prefix.size())));
  } catch (const std::exception& error) {
    std::fputs(fmt::format("verify: {}\n", error.what()).c_str(), stderr);
    return 1;
  }
  return 0;
}
