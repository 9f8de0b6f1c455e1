// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whole studies measured, each in a process of its own: `make bench`, or
///   rubato_bench_studies --quick                    a few in a minute
///   rubato_bench_studies c c-refined-4              these
///   rubato_bench_studies --page docs/performance.md all, into the tables of a page
#include "rubato/linalg/blas_threads.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "page.hpp"
#include "study.hpp"
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace rubato::bench;

const Study& study_named(const std::string& name) {
  return *std::ranges::find(studies(), name, &Study::name);
}

std::vector<std::string> names(bool quick_only) {
  std::vector<std::string> all;
  for (const auto& study : studies())
    if (study.quick || !quick_only)
      all.push_back(study.name);
  return all;
}

/// The measurement that this program prints when told to measure one study.
Measurement measure_apart(const std::string& name) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").string();
  const auto command = fmt::format("'{}' --measure {}", program, name);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  if (pipe)
    for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
      text += static_cast<char>(c);
  if (text.empty())
    throw std::runtime_error(name + " was not measured");
  return from_json(text);
}

/// The page has what is measured so far after every study: the large ones take long.
std::string measure_all(const std::vector<std::string>& chosen, const std::string& page) {
  std::vector<Measurement> all;
  std::string table;
  for (const auto& name : chosen) {
    fmt::print(stderr, "{} …\n", name);
    all.push_back(measure_apart(name));
    table = table_of(all);
    if (!page.empty())
      write_part(page, "studies", fmt::format("{}\n\n{}", machine_line(), table));
  }
  return table;
}

int run(int argc, char** argv) {
  CLI::App app("Measures whole studies of cases/sdnl140.");
  std::vector<std::string> chosen;
  std::string one;
  std::string page;
  std::string kernels;
  bool quick = false;
  app.add_option("studies", chosen, "which; all when none is named")->check(CLI::IsMember(names(false)));
  app.add_flag("--quick", quick, "a set that takes a minute");
  app.add_option("--measure", one, "one study in this process, printed as JSON")
      ->check(CLI::IsMember(names(false)));
  app.add_option("--page", page, "write the tables of this page")->check(CLI::ExistingFile);
  app.add_option("--kernels", kernels, "Google Benchmark's JSON, for the page's other table")
      ->check(CLI::ExistingFile);
  CLI11_PARSE(app, argc, argv);
  if (!one.empty()) {
    fmt::print("{}\n", to_json(measure(study_named(one))));
    return 0;
  }
  const auto table = measure_all(chosen.empty() ? names(quick) : chosen, page);
  fmt::print("{}\n\n{}", machine_line(), table);
  if (!page.empty() && !kernels.empty())
    write_part(page, "kernels", fmt::format("{}\n\n{}", machine_line(), table_of_kernels(kernels)));
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  // Processor time is that of all threads: idle ones of OpenBLAS would be counted.
  rubato::linalg::start_with_one_blas_thread_by_default();
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 1;
  }
}
