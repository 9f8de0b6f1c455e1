// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/checks.hpp"
#include "rubato/results/stored_run.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include <algorithm>

namespace rubato::app {

int check(const CheckArguments& arguments) {
  int code = done;
  for (const auto& folder : results::run_folders(arguments.folder)) {
    const auto run = results::read_stored_run(folder);
    const auto checks = results::evaluate_checks(run.study.checks, run.probes);
    fmt::print("{}: {}\n", run.study.name, run.complete ? "complete" : run.reason);
    if (checks.empty())
      fmt::print("no checks in the deck\n");
    else
      fmt::print("{}", results::to_text(checks));
    const bool hold = std::ranges::all_of(checks, &results::CheckResult::holds);
    code = std::max<int>(code, !run.complete ? no_convergence : hold ? done : check_failed);
  }
  return code;
}

} // namespace rubato::app
