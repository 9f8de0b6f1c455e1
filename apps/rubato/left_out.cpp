// SPDX-License-Identifier: LGPL-3.0-or-later
// A build with RUBATO_RUNS_ONLY compiles this source in place of plot.cpp, report.cpp, read_inp.cpp and
// write_inp.cpp.
#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "read_inp.hpp"
#include "write_inp.hpp"

namespace rubato::app {
namespace {

[[noreturn]] void refuse(std::string_view what) {
  throw InputError(
      fmt::format("{}: not in this program, which was built with RUBATO_RUNS_ONLY, as `make demo` does; "
                  "`make build` builds all of it",
                  what));
}

} // namespace

int plot(const PlotArguments&) {
  refuse("rubato plot");
}

int print_quantity_names(const ShellArguments&) {
  refuse("rubato quantity-names");
}

int report(const ReportArguments&) {
  refuse("rubato report");
}

void write_inp(const DeckArguments& arguments) {
  refuse(arguments.output.string());
}

StepsDeck read_inp(const std::filesystem::path& file, inp::Purpose, std::span<const deck::Setting>,
                   std::span<const std::string>) {
  refuse(file.string());
}

} // namespace rubato::app
