// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/plot/contact_lines.hpp"
#include "rubato/plot/deformed.hpp"
#include "rubato/plot/histories.hpp"
#include "rubato/plot/picture_file.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/stored_run.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include <algorithm>
#include <array>
#include <set>

namespace rubato::app {
namespace {

plot::PlottedRun read_run(const std::filesystem::path& folder) {
  const auto stored = results::read_stored_run(folder);
  return {folder, stored.name, deck::parse_echo(stored.study, (folder / results::summary_file).string())};
}

/// Runs of one name are told apart by their folders.
void make_labels_unique(std::vector<plot::PlottedRun>& runs) {
  std::vector<std::string> names(runs.size());
  std::ranges::transform(runs, names.begin(), &plot::PlottedRun::label);
  for (auto& run : runs)
    if (std::ranges::count(names, run.label) > 1)
      run.label = run.folder.string();
}

/// Every folder is a run's or holds runs.
std::vector<plot::PlottedRun> read_runs(const std::vector<std::filesystem::path>& folders) {
  std::vector<plot::PlottedRun> runs;
  for (const auto& folder : folders) {
    if (!std::filesystem::is_directory(folder))
      throw InputError(
          fmt::format("{}: there is no such folder, expected the folder of a run", folder.string()));
    for (const auto& path : results::run_folders(folder))
      runs.push_back(read_run(path));
  }
  make_labels_unique(runs);
  return runs;
}

/// Two numbers with a comma between them.
std::array<double, 2> pair_of(const std::vector<double>& numbers, const char* option) {
  if (numbers.size() != 2)
    throw InputError(fmt::format("{}: found {} number{}, expected two with a comma between them", option,
                                 numbers.size(), numbers.size() == 1 ? "" : "s"));
  return {numbers[0], numbers[1]};
}

plot::DeformedChoice deformed_choice(const PlotArguments& arguments) {
  plot::DeformedChoice choice{.field = arguments.field, .scale = arguments.scale};
  if (arguments.at.size() > 1)
    throw InputError(fmt::format("--at: found {} instants, expected one with --field", arguments.at.size()));
  if (!arguments.at.empty())
    choice.at = arguments.at.front();
  if (!arguments.view.empty())
    choice.view = pair_of(arguments.view, "--view");
  if (!arguments.range.empty()) {
    const auto [low, high] = pair_of(arguments.range, "--range");
    if (!(low < high))
      throw InputError(
          fmt::format("--range: found {:g},{:g}, expected a number and a larger one", low, high));
    choice.range = {low, high};
  }
  return choice;
}

std::string field_picture(const PlotArguments& arguments, const std::vector<plot::PlottedRun>& runs) {
  if (runs.size() > 1)
    throw InputError(fmt::format("--field: found {} runs, expected one; the first is {}", runs.size(),
                                 runs.front().folder.string()));
  return plot::deformed_svg(runs.front(), deformed_choice(arguments), arguments.width, arguments.height);
}

std::string curves(const PlotArguments& arguments, const std::vector<plot::PlottedRun>& runs) {
  auto figure = arguments.line.empty()
                    ? plot::histories(runs, {arguments.history, arguments.against})
                    : plot::contact_lines(runs, {arguments.line, arguments.at, arguments.along});
  if (!arguments.reference.empty())
    plot::add_reference(figure, arguments.reference);
  return plot::to_svg(figure, {arguments.width, arguments.height.value_or(plot::usual_height(figure))});
}

/// Larger pictures no viewer takes.
void require_size(const PlotArguments& arguments) {
  constexpr int most_pixels = 10'000;
  for (const int pixels : {arguments.width, arguments.height.value_or(1)})
    if (pixels < 1 || pixels > most_pixels)
      throw InputError(fmt::format("found a size of {} pixels, expected 1 to {}", pixels, most_pixels));
}

std::filesystem::path output_of(const PlotArguments& arguments) {
  if (!arguments.output.empty())
    return arguments.output;
  return !arguments.field.empty() ? "field.svg" : !arguments.line.empty() ? "line.svg" : "history.svg";
}

} // namespace

int plot(const PlotArguments& arguments) {
  const auto output = output_of(arguments);
  plot::require_picture_name(output);
  require_size(arguments);
  if (!arguments.at.empty() && arguments.line.empty() && arguments.field.empty())
    throw InputError("--at: found instants for histories, expected --line or --field beside them");
  const auto runs = read_runs(arguments.runs);
  plot::write_picture(output,
                      arguments.field.empty() ? curves(arguments, runs) : field_picture(arguments, runs));
  fmt::print("written to {}\n", output.string());
  return done;
}

int print_quantity_names(const ShellArguments& arguments) {
  std::set<std::string> names;
  for (const auto& run : read_runs(arguments.runs))
    for (auto& name : plot::quantity_names(run))
      names.insert(std::move(name));
  for (const auto& name : names)
    fmt::print("{}\n", name);
  return done;
}

} // namespace rubato::app
