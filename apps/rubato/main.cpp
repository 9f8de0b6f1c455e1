// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/memory.hpp"
#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <new>
#include <sys/resource.h>

namespace {

using namespace rubato;

/// What the command line says; the subcommand that was chosen reads its part.
struct Arguments {
  app::RunArguments run;
  app::CheckArguments check;
  app::CompareArguments compare;
  app::InfoArguments info;
  app::MeshArguments mesh;
  std::function<int()> work;
};

void add_run(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("run", "run a study");
  auto& run = arguments.run;
  command->add_option("deck", run.deck, "the study, a YAML file")->required();
  command->add_option("-o,--output", run.output,
                      "folder of results; each run gets a folder in it (default: the deck's name)");
  command->add_option("--set", run.settings, "change the deck: path.to.key=value")->allow_extra_args(false);
  command
      ->add_option(
          "--only", run.only,
          "run only these runs of the deck, and those they start from unless their results are there")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--resume", run.resume,
                    "go on from the checkpoints in the folder of results; runs at their end are left alone");
  command->add_flag("-q,--quiet", run.quiet, "print checks and errors only");
  command->callback([&arguments] { arguments.work = [&] { return app::run(arguments.run); }; });
}

void add_check(CLI::App& program, Arguments& arguments) {
  auto* command =
      program.add_subcommand("check", "hold the results of a finished run against its references again");
  command->add_option("folder", arguments.check.folder, "a run's folder, or a folder of runs")->required();
  command->callback([&arguments] { arguments.work = [&] { return app::check(arguments.check); }; });
}

void add_compare(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("compare", "the difference A - B of two runs");
  auto& compare = arguments.compare;
  command->add_option("run_a", compare.a, "folder of run A")->required();
  command->add_option("run_b", compare.b, "folder of run B")->required();
  command->add_option("--at", compare.at, "instant (of --probe: all common ones when not given)");
  auto* field = command->add_option("--field", compare.field, "field at the nodes (default: displacement)");
  auto* node = command->add_option("--node", compare.node, "at a node: N90, a group of one node, a probe");
  auto* group = command->add_option("--group", compare.group, "over the nodes of a group");
  auto* norms = command->add_flag("--norms", compare.norms, "over the whole mesh (default)");
  auto* output =
      command->add_option("-o,--output", compare.output, "write the difference for ParaView (.vtu)");
  auto* probe = command->add_option("--probe", compare.probe, "compare histories: tip, or tip.y");
  for (auto* of_fields : {field, node, group, static_cast<CLI::Option*>(norms), output})
    probe->excludes(of_fields);
  command->add_option("--tolerance", compare.tolerance, "fail when the largest difference is beyond it");
  command->callback([&arguments] { arguments.work = [&] { return app::compare(arguments.compare); }; });
}

void add_info(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("info", "say what a mesh file holds and what looks wrong");
  command
      ->add_option("file", arguments.info.file,
                   fmt::format("mesh file ({})", rubato::mesh::readable_endings()))
      ->required();
  command->add_option("--mesh", arguments.info.mesh_name, "name of the mesh inside the file");
  command->callback([&arguments] { arguments.work = [&] { return app::info(arguments.info); }; });
}

void add_mesh(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("mesh", "write the mesh of a deck, or convert a mesh file");
  auto& mesh = arguments.mesh;
  command
      ->add_option("source", mesh.source,
                   fmt::format("a deck (.yaml) or a mesh file ({})", rubato::mesh::readable_endings()))
      ->required();
  command->add_option("output", mesh.output, "file to write (.med, .vtu)")->required();
  command->add_option("--set", mesh.settings, "change the deck: path.to.key=value")->allow_extra_args(false);
  command->add_option("--convert", mesh.convert, "linear, quadratic or full_quadratic");
  command->add_option("--refine", mesh.refine, "cut every edge into that many parts");
  command->callback([&arguments] { arguments.work = [&] { return app::mesh(arguments.mesh); }; });
}

void add_list(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("list", "list cells, schemes, methods, laws and formats");
  command->callback([&arguments] { arguments.work = [] { return app::list(); }; });
}

/// The version, and which of the parts that a build may lack this one has.
std::string version_text() {
  return fmt::format("rubato {}\nGmsh geometries (.geo): {}", version,
                     rubato::mesh::is_gmsh_built_in() ? "built in; Gmsh's library is loaded when one is read"
                                                      : "not built in (make deps GMSH=1, then build again)");
}

/// A first word that is no subcommand is better told with those there are.
void refuse_unknown_command(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const auto* command : program.get_subcommands(nullptr))
    names.push_back(command->get_name());
  if (word.starts_with('-') || std::ranges::find(names, word) != names.end())
    return;
  const auto nearest = nearest_word(word, names);
  throw InputError(fmt::format("found '{}', expected one of {}{}", word, fmt::join(names, ", "),
                               nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

int parse_and_work(int argc, char** argv) {
  CLI::App program("rubato: how elastic bodies move, touch, rub and part", "rubato");
  program.set_version_flag("--version", version_text());
  program.require_subcommand(1);
  Arguments arguments;
  add_run(program, arguments);
  add_check(program, arguments);
  add_compare(program, arguments);
  add_info(program, arguments);
  add_mesh(program, arguments);
  add_list(program, arguments);
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
