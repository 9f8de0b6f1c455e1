// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/petsc_module.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command_line.hpp"
#include "failures.hpp"
#include "ranks.hpp"
#include <csignal>
#include <cstdio>
#include <string_view>

namespace {

using namespace rubato;

/// A first word that is no subcommand is better told with those there are.
void refuse_unknown_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const auto* command : app::shown_commands(program))
    names.push_back(command->get_name());
  const auto is_meant = [&](const CLI::App* command) { return command->get_name() == word; };
  if (word.starts_with('-') || std::ranges::any_of(program.get_subcommands(nullptr), is_meant))
    return;
  const auto nearest = nearest_word(word, names);
  throw InputError(fmt::format("found '{}', expected one of {}{}", word, fmt::join(names, ", "),
                               nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

int parse_and_work(int argc, char** argv) {
  app::Arguments arguments;
  CLI::App program(app::about, "rubato");
  app::declare(program, arguments);
  if (argc < 2) {
    fmt::print(stderr, "{}", program.help());
    return app::bad_input;
  }
  refuse_unknown_command(program, argv[1]);
  if (linalg::started_index() > 0 && std::string_view(argv[1]) != "run")
    return app::done; // the first rank does it alone
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return program.exit(error);
    throw InputError(fmt::format("{} (rubato --help tells more)", error.what()));
  }
  return arguments.work();
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is told of, as a full disk is
  rubato::linalg::start_with_one_blas_thread_by_default();
  rubato::app::hush_other_ranks();
  const int code = rubato::app::reported([&] { return parse_and_work(argc, argv); });
  if (code == rubato::app::other_failure)
    rubato::app::leave(code);
  return code;
}
