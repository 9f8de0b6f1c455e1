// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/memory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command_line.hpp"
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <sys/resource.h>

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
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0)
      return program.exit(error);
    throw InputError(fmt::format("{} (rubato --help tells more)", error.what()));
  }
  return arguments.work();
}

/// What the memory was, and what else could be done. By now what the run had is given back.
std::string out_of_memory() {
  constexpr double gigabyte = 1e9;
  constexpr double kibibyte = 1024;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return fmt::format(
      "the memory does not suffice: {:.2g} GB were taken, {:.2g} GB can be had now; a coarser mesh, "
      "cells of lower order or a machine with more memory may help (ulimit -v limits it too)",
      static_cast<double>(usage.ru_maxrss) * kibibyte / gigabyte,
      static_cast<double>(linalg::available_memory()) / gigabyte);
}

int report(const InputError& error) {
  for (const auto& fault : error.faults()) {
    const auto place = place_of(fault);
    fmt::print(stderr, "error: {}{}{}\n", place, place.empty() ? "" : ": ", fault.text);
  }
  return app::bad_input;
}

/// Ends the program without asking the libraries: one that could not write a file may break down over it.
[[noreturn]] void leave(int code) {
  std::fflush(nullptr);
  std::_Exit(code);
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is told of, as a full disk is
  rubato::linalg::start_with_one_blas_thread_by_default();
  try {
    const int code = parse_and_work(argc, argv);
    if (code == app::other_failure)
      leave(code);
    return code;
  } catch (const InputError& error) {
    return report(error);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: {}\n", out_of_memory());
    leave(app::other_failure);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    leave(app::other_failure);
  }
}
