// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/error.hpp"
#include "rubato/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.hpp"
#include <functional>

namespace {

using namespace rubato;

/// Adds the subcommands; the one that is chosen leaves its work in `work`.
void add_commands(CLI::App& program, std::function<int()>& work) {
  static app::RunArguments run;
  auto* command = program.add_subcommand("run", "run a study");
  command->add_option("deck", run.deck, "the study, a YAML file")->required();
  command->add_option("-o,--output", run.output,
                      "folder of results; each run gets a folder in it (default: the deck's name)");
  command->add_option("--set", run.settings, "change the deck: path.to.key=value")->allow_extra_args(false);
  command->add_option("--only", run.only, "run only these runs of the deck (and those they start from)")
      ->delimiter(',');
  command->add_flag("-q,--quiet", run.quiet, "print checks and errors only");
  command->callback([&work] { work = [] { return app::run(run); }; });

  static app::CheckArguments check;
  command =
      program.add_subcommand("check", "hold the results of a finished run against its references again");
  command->add_option("folder", check.folder, "a run's folder, or a folder of runs")->required();
  command->callback([&work] { work = [] { return app::check(check); }; });

  static app::InfoArguments info;
  command = program.add_subcommand("info", "say what a mesh file holds and what looks wrong");
  command->add_option("file", info.file, "mesh file (.med, .msh, .geo)")->required();
  command->add_option("--mesh", info.mesh_name, "name of the mesh inside the file");
  command->callback([&work] { work = [] { return app::info(info); }; });

  static app::MeshArguments mesh;
  command = program.add_subcommand("mesh", "write the mesh of a deck, or convert a mesh file");
  command->add_option("source", mesh.source, "a deck (.yaml) or a mesh file")->required();
  command->add_option("output", mesh.output, "file to write (.med, .vtu)")->required();
  command->add_option("--set", mesh.settings, "change the deck: path.to.key=value")->allow_extra_args(false);
  command->add_option("--convert", mesh.convert, "linear, quadratic or full_quadratic");
  command->add_option("--refine", mesh.refine, "cut every edge into that many parts");
  command->callback([&work] { work = [] { return app::mesh(mesh); }; });

  command = program.add_subcommand("list", "list cells, schemes, methods, laws and formats");
  command->callback([&work] { work = [] { return app::list(); }; });
}

int report(const InputError& error) {
  for (const auto& fault : error.faults()) {
    const auto place = to_string(fault.at);
    fmt::print(stderr, "error: {}{}{}\n", place, place.empty() ? "" : ": ", fault.text);
  }
  return app::bad_input;
}

} // namespace

int main(int argc, char** argv) {
  try {
    CLI::App program("rubato: how elastic bodies move, touch, rub and part", "rubato");
    program.set_version_flag("--version", fmt::format("rubato {}", version));
    program.require_subcommand(1);
    std::function<int()> work;
    add_commands(program, work);
    try {
      program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      return program.exit(error) == 0 ? app::done : app::bad_input;
    }
    return work();
  } catch (const InputError& error) {
    return report(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return app::other_failure;
  }
}
