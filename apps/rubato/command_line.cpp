// SPDX-License-Identifier: LGPL-3.0-or-later
#include "command_line.hpp"

#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <string>
#include <system_error>

namespace rubato::app {
namespace {

/// Says what is wrong with a text that is no whole number from 1 on; nothing otherwise.
std::string a_count(const std::string& text) {
  int number = 0;
  const auto* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error == std::errc() && stop == end && number > 0)
    return {};
  return fmt::format("found '{}', expected a whole number from 1 on", text);
}

void add_run(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("run", "run a study");
  auto& run = arguments.run;
  command
      ->add_option(
          "deck", run.deck,
          "the study, a YAML file or an .inp file (Abaqus, CalculiX); - reads YAML from standard input")
      ->required()
      ->type_name(kind::deck);
  command
      ->add_option("-o,--output", run.output,
                   "folder of results; each run gets a folder in it (default: the deck's name)")
      ->type_name(kind::folder);
  command->add_option("--set", run.settings, "change the deck: path.to.key=value")
      ->allow_extra_args(false)
      ->type_name(kind::setting);
  command
      ->add_option(
          "--only", run.only,
          "run only these runs of the deck, and those they start from unless their results are there")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name(kind::runs);
  command->add_option("--jobs", run.jobs, "as many runs of the deck at once (default: 1)")
      ->check(a_count)
      ->type_name(kind::number);
  command->add_flag("--resume", run.resume,
                    "go on from the checkpoints in the folder of results; runs at their end are left alone");
  command->add_flag("--dry-run", run.dry, "say what would be run and where, with its size; write nothing");
  command
      ->add_option("--threads", run.threads,
                   "threads that each run may use (default: one a core, or RUBATO_THREADS)")
      ->type_name(kind::number)
      ->check(a_count)
      ->envname("RUBATO_THREADS");
  command->add_flag("-q,--quiet", run.quiet, "print checks and errors only");
  command->callback([&arguments] { arguments.work = [&] { return app::run(arguments.run); }; });
}

void add_modes(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("modes", "natural frequencies and shapes of a study's bodies");
  auto& modes = arguments.modes;
  command
      ->add_option("deck", modes.deck,
                   "the study, a YAML file or an .inp file with *FREQUENCY; - reads YAML from standard input")
      ->required()
      ->type_name(kind::deck);
  command
      ->add_option("--number", modes.number,
                   "how many of the lowest modes (default: 10, or as *FREQUENCY says)")
      ->type_name(kind::number);
  command
      ->add_option(
          "--contact", modes.contact,
          "what becomes of points that touch in the undeformed bodies: they are free, held together, "
          "or held along the normal (default: open)")
      ->type_name("open|stuck|sliding");
  command->add_option("--only", modes.only, "of these runs of the deck (default: the first)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name(kind::runs);
  command->add_option("--set", modes.settings, "change the deck: path.to.key=value")
      ->allow_extra_args(false)
      ->type_name(kind::setting);
  command
      ->add_option("-o,--output", modes.output,
                   "folder of results; each run gets a folder in it (default: the deck's name)")
      ->type_name(kind::folder);
  command->callback([&arguments] { arguments.work = [&] { return app::modes(arguments.modes); }; });
}

void add_deck(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("deck", "write the steps of an .inp file (Abaqus, CalculiX) as a "
                                                 "deck, or a deck with its changes; or either as an "
                                                 "input file of CalculiX");
  auto& deck = arguments.deck;
  command->add_option("source", deck.source, "an .inp file, or a YAML deck; - reads it from standard input")
      ->required()
      ->type_name(kind::deck);
  command->add_option("--only", deck.only, "these runs of it alone, and those they start from")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name(kind::runs);
  command->add_option("--set", deck.settings, "change the deck: path.to.key=value")
      ->allow_extra_args(false)
      ->type_name(kind::setting);
  command
      ->add_option("-o,--output", deck.output,
                   "file to write (default: standard output); FILE.inp: an input file of CalculiX")
      ->type_name(kind::file);
  command
      ->add_option("--modes", deck.modes,
                   "of an input file of CalculiX: so many natural modes of the first run instead of the runs")
      ->type_name(kind::number);
  command->callback([&arguments] { arguments.work = [&] { return app::write_deck(arguments.deck); }; });
}

void add_check(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand(
      "check", "look for faults in a deck, or hold a finished run against its references again");
  command
      ->add_option(
          "what", arguments.check.what,
          "a deck or an .inp file (- reads a deck from standard input), a run's folder, or a folder of runs")
      ->required()
      ->type_name(kind::deck_or_folder);
  command->add_flag("--markdown", arguments.check.markdown,
                    "of a run: print its checks as a table in Markdown");
  command->callback([&arguments] { arguments.work = [&] { return app::check(arguments.check); }; });
}

void add_compare(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("compare", "the difference A - B of two runs");
  auto& compare = arguments.compare;
  command->add_option("run_a", compare.a, "folder of run A")->required()->type_name(kind::folder);
  command->add_option("run_b", compare.b, "folder of run B")->required()->type_name(kind::folder);
  command->add_option("--at", compare.at, "instant (of --probe: all common ones when not given)")
      ->type_name(kind::number);
  auto* field = command->add_option("--field", compare.field, "field at the nodes (default: displacement)")
                    ->type_name(kind::name);
  auto* node = command->add_option("--node", compare.node, "at a node: N90, a group of one node, a probe")
                   ->type_name(kind::name);
  auto* group =
      command->add_option("--group", compare.group, "over the nodes of a group")->type_name(kind::name);
  auto* norms = command->add_flag("--norms", compare.norms, "over the whole mesh (default)");
  auto* output =
      command->add_option("-o,--output", compare.output, "write the difference for ParaView (.vtu)")
          ->type_name(kind::file);
  auto* probe = command->add_option("--probe", compare.probe, "compare histories: tip, or tip.y")
                    ->type_name(kind::name);
  for (auto* of_fields : {field, node, group, static_cast<CLI::Option*>(norms), output})
    probe->excludes(of_fields);
  command->add_option("--tolerance", compare.tolerance, "fail when the largest difference is beyond it")
      ->type_name(kind::number);
  command->callback([&arguments] { arguments.work = [&] { return app::compare(arguments.compare); }; });
}

CLI::Option* add_history_options(CLI::App& command, PlotArguments& plot) {
  auto* history =
      command
          .add_option("--history", plot.history,
                      "curves over time: a probe (tip, tip.y), energy.COLUMN, ZONE.COLUMN of the resultants "
                      "(default: every probe)")
          ->delimiter(',')
          ->allow_extra_args(false)
          ->type_name(kind::quantities);
  command
      .add_option("--against", plot.against,
                  "with --history: over this quantity instead of the time, as a hysteresis loop")
      ->needs(history)
      ->type_name(kind::quantity);
  return history;
}

CLI::Option* add_line_options(CLI::App& command, PlotArguments& plot) {
  auto* line =
      command
          .add_option("--line", plot.line,
                      "pressure along a contact zone (fit), or another column of its table (fit.gap)")
          ->type_name(kind::name);
  command
      .add_option("--along", plot.along,
                  "with --line: over the arc length s or a coordinate (default: s in the plane, else the "
                  "longest axis)")
      ->needs(line)
      ->type_name("s|x|y|z");
  return line;
}

CLI::Option* add_field_options(CLI::App& command, PlotArguments& plot) {
  auto* field = command
                    .add_option("--field", plot.field,
                                "the deformed bodies with a stored field in colours: von_mises, stress.xx, "
                                "displacement (its length)")
                    ->type_name(kind::name);
  command.add_option("--scale", plot.scale, "with --field: enlarge displacements (default: 1)")
      ->needs(field)
      ->type_name(kind::number);
  command
      .add_option("--view", plot.view,
                  "with --field, in space: degrees about z from x and above the xy plane (default: -60,30)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->needs(field)
      ->type_name(kind::numbers);
  command
      .add_option("--range", plot.range,
                  "with --field: lowest and highest value of the colours (default: those of the field)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->needs(field)
      ->type_name(kind::numbers);
  return field;
}

void add_picture_options(CLI::App& command, PlotArguments& plot) {
  command
      .add_option("-o,--output", plot.output,
                  "file to write, .svg or .png (default: history.svg, line.svg or field.svg)")
      ->type_name(kind::file);
  command.add_option("--width", plot.width, "of the picture in pixels (default: 800)")
      ->type_name(kind::number);
  command.add_option("--height", plot.height, "of the picture in pixels (default: as its content suits)")
      ->type_name(kind::number);
}

void add_plot(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand(
      "plot", "draw histories, contact along a line, or a field on the deformed bodies (SVG, PNG)");
  auto& plot = arguments.plot;
  command
      ->add_option("run", plot.runs, "folders of runs, or folders that hold runs; curves of all in one plot")
      ->required()
      ->type_name(kind::folder);
  auto* history = add_history_options(*command, plot);
  auto* line = add_line_options(*command, plot);
  auto* field = add_field_options(*command, plot);
  history->excludes(line)->excludes(field);
  line->excludes(field);
  command
      ->add_option("--at", plot.at,
                   "with --line: instants, a curve each; with --field: the instant (default: the last one "
                   "stored)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->excludes(history)
      ->type_name(kind::numbers);
  command
      ->add_option("--reference", plot.reference,
                   "with curves: also the line of an expression of the abscissa x, as 45e6*sqrt(1-(x/2)^2)")
      ->excludes(field)
      ->type_name(kind::expression);
  add_picture_options(*command, plot);
  command->callback([&arguments] { arguments.work = [&] { return app::plot(arguments.plot); }; });
}

void add_report(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand(
      "report", "write a run as one HTML file: view, curves, checks, convergence; or two side by side");
  constexpr int most_runs = 2;
  command->add_option("runs", arguments.report.runs, "folder of a run, or of two")
      ->required()
      ->expected(1, most_runs)
      ->type_name(kind::folder);
  command
      ->add_option("-o,--output", arguments.report.output,
                   "file to write (default: report.html in the folder of the first run)")
      ->type_name(kind::file);
  command->callback([&arguments] { arguments.work = [&] { return app::report(arguments.report); }; });
}

void add_info(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("info", "say what a mesh file holds and what looks wrong");
  command
      ->add_option("file", arguments.info.file,
                   fmt::format("mesh file ({})", rubato::mesh::readable_endings()))
      ->required()
      ->type_name(kind::mesh);
  command->add_option("--mesh", arguments.info.mesh_name, "name of the mesh inside the file")
      ->type_name(kind::name);
  command->callback([&arguments] { arguments.work = [&] { return app::info(arguments.info); }; });
}

void add_mesh(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("mesh", "write the mesh of a deck, or convert a mesh file");
  auto& mesh = arguments.mesh;
  command
      ->add_option("source", mesh.source,
                   fmt::format("a deck (.yaml, or - for standard input) or a mesh file ({})",
                               rubato::mesh::readable_endings()))
      ->required()
      ->type_name(kind::deck_or_mesh);
  command->add_option("output", mesh.output, "file to write (.med, .mail, .vtu)")
      ->required()
      ->type_name(kind::file);
  command->add_option("--set", mesh.settings, "change the deck: path.to.key=value")
      ->allow_extra_args(false)
      ->type_name(kind::setting);
  command->add_option("--convert", mesh.convert, "change the cells' degree")
      ->type_name("linear|quadratic|full_quadratic");
  command->add_option("--refine", mesh.refine, "cut every edge into that many parts")
      ->type_name(kind::number);
  command
      ->add_option("--group", mesh.groups,
                   "make a group, as a deck's mesh.groups do: 'top={normal: [0, 0, 1]}'")
      ->allow_extra_args(false)
      ->type_name(kind::group);
  command->callback([&arguments] { arguments.work = [&] { return app::mesh(arguments.mesh); }; });
}

void add_aster(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand(
      "aster", "run a Code_Aster study; its command file is a Python program and runs with your rights");
  auto& aster = arguments.aster;
  command->add_option("study", aster.study, "a command file (.comm) or an .export file")
      ->required()
      ->type_name(kind::study);
  command
      ->add_option("-o,--output", aster.output,
                   "run folder, where relative paths of the commands are (default: out/NAME)")
      ->type_name(kind::folder);
  command->add_option("--file", aster.files, "the file of a unit")
      ->allow_extra_args(false)
      ->type_name(kind::unit);
  command->add_flag("--check", aster.check, "only look for what is not available");
  command
      ->add_option("--time", aster.time,
                   "largest time of the run in seconds (default: the study's, at least 900)")
      ->type_name(kind::number);
  command
      ->add_option("--memory", aster.memory,
                   "largest memory of the run in MB (default: four fifths of what is free)")
      ->type_name(kind::number);
  command
      ->add_option("--regression-tolerance", aster.regression_tolerance,
                   "relative tolerance of values of Code_Aster itself, VALE_CALC (default: 1e-3)")
      ->type_name(kind::number);
  command->callback([&arguments] { arguments.work = [&] { return app::aster(arguments.aster); }; });
}

void add_list(CLI::App& program, Arguments& arguments) {
  auto* command = program.add_subcommand("list", "list cells, schemes, methods, laws and formats");
  command->callback([&arguments] { arguments.work = [] { return app::list(); }; });
}

void add_schema(CLI::App& program, Arguments& arguments) {
  auto* command =
      program.add_subcommand("schema", "print the JSON Schema of decks, by which editors complete and check");
  command->callback([&arguments] { arguments.work = [] { return app::schema(); }; });
}

void add_new(CLI::App& program, Arguments& arguments) {
  auto* command =
      program.add_subcommand("new", "write a commented deck to begin with; without a name, list them");
  auto& chosen = arguments.new_deck;
  command->add_option("name", chosen.name, "what the deck is about")
      ->type_name(fmt::format("{}", fmt::join(template_names(), "|")));
  command
      ->add_option("-o,--output", chosen.output,
                   "file to write; - writes to standard output (default: NAME.yaml)")
      ->type_name(kind::file);
  command->callback([&arguments] { arguments.work = [&] { return app::new_deck(arguments.new_deck); }; });
}

/// For the build and for completions, not for people.
void add_shell(CLI::App& program, Arguments& arguments) {
  auto* files =
      program.add_subcommand("shell-files", "write man pages and completions into a folder")->group("");
  files->add_option("folder", arguments.shell.folder, "as /usr/share")->required()->type_name(kind::folder);
  files->callback([&arguments] { arguments.work = [&] { return app::write_shell_files(arguments.shell); }; });
  auto* runs = program.add_subcommand("run-names", "print the runs of a deck, one a line")->group("");
  runs->add_option("deck", arguments.shell.deck, "the study")->required()->type_name(kind::deck);
  runs->callback([&arguments] { arguments.work = [&] { return app::print_run_names(arguments.shell); }; });
  auto* quantities =
      program.add_subcommand("quantity-names", "print what histories of runs have, one a line")->group("");
  quantities->add_option("run", arguments.shell.runs, "folders")->required()->type_name(kind::folder);
  quantities->callback(
      [&arguments] { arguments.work = [&] { return app::print_quantity_names(arguments.shell); }; });
}

/// The version, and which of the parts that a build may lack this one has.
std::string version_text() {
  return fmt::format("rubato {}\nGmsh geometries (.geo): {}", version,
                     rubato::mesh::is_gmsh_built_in() ? "built in; Gmsh's library is loaded when one is read"
                                                      : "not built in (make deps GMSH=1, then build again)");
}

} // namespace

std::vector<const CLI::App*> shown_commands(const CLI::App& program) {
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

void declare(CLI::App& program, Arguments& arguments) {
  program.set_help_flag("-h,--help", "print this help");
  program.set_version_flag("--version", version_text(), "print version and optional parts");
  program.require_subcommand(1);
  program.footer("Exit codes: 0 done and all checks pass, 1 a check fails, 2 bad input, 3 no convergence, 4 "
                 "any other end.");
  add_run(program, arguments);
  add_modes(program, arguments);
  add_new(program, arguments);
  add_deck(program, arguments);
  add_check(program, arguments);
  add_compare(program, arguments);
  add_plot(program, arguments);
  add_report(program, arguments);
  add_info(program, arguments);
  add_mesh(program, arguments);
  add_aster(program, arguments);
  add_list(program, arguments);
  add_schema(program, arguments);
  add_shell(program, arguments);
}

} // namespace rubato::app
