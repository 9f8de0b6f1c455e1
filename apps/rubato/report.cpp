// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/report.hpp"

#include "rubato/results/run_folder.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "require_run.hpp"

namespace rubato::app {
namespace {

/// Beside the results of the first run.
std::filesystem::path file_of(const ReportArguments& arguments) {
  if (!arguments.output.empty())
    return arguments.output;
  return arguments.runs.front() / results::report_file;
}

} // namespace

int report(const ReportArguments& arguments) {
  for (const auto& run : arguments.runs)
    require_run(run);
  const auto file = file_of(arguments);
  const auto written = report::write_report(arguments.runs, file);
  for (const auto& note : written.notes)
    fmt::print(stderr, "{}\n", note);
  constexpr double megabyte = 1e6;
  fmt::print("{}: {:.1f} MB, for a browser\n", file.string(), static_cast<double>(written.bytes) / megabyte);
  return done;
}

} // namespace rubato::app
