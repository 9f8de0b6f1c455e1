// SPDX-License-Identifier: LGPL-3.0-or-later
/// What each subcommand does once its arguments are parsed. All return the program's exit code.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rubato::app {

/// 0 done and all checks hold, 1 a check failed, 2 bad input, 3 no convergence, 4 anything else.
enum ExitCode : int { done = 0, check_failed = 1, bad_input = 2, no_convergence = 3, other_failure = 4 };

struct RunArguments {
  std::filesystem::path deck;
  std::filesystem::path output;
  std::vector<std::string> settings; ///< "path.to.key=value"
  std::vector<std::string> only;     ///< names of runs
  int jobs = 1;                      ///< runs at once
  bool resume = false;
  bool dry = false; ///< say what would be run
  bool quiet = false;
  int threads = 0; ///< 0: as many as there are cores
};
int run(const RunArguments& arguments);

struct ModesArguments {
  std::filesystem::path deck;
  std::filesystem::path output;
  std::vector<std::string> settings; ///< "path.to.key=value"
  std::vector<std::string> only;     ///< names of runs; empty: the first
  std::optional<int> number;         ///< 10, or what an .inp file asks for
  std::string contact = "open";
};
int modes(const ModesArguments& arguments);

/// What a deck is written of: the steps of an .inp file, or the runs of a deck with their changes.
struct DeckArguments {
  std::filesystem::path source;
  std::filesystem::path output; ///< empty: standard output; .inp: an input file of CalculiX
  std::optional<int> modes;     ///< of an input file of CalculiX: that many natural modes instead of the runs
  std::vector<std::string> settings;
  std::vector<std::string> only;
};
int write_deck(const DeckArguments& arguments);

struct CheckArguments {
  std::filesystem::path what; ///< a deck, or a folder of results
  bool markdown = false;      ///< checks as a table in Markdown
};
int check(const CheckArguments& arguments);

/// What is looked at in two runs: a field at an instant, or the histories of a probe.
struct CompareArguments {
  std::filesystem::path a;
  std::filesystem::path b;
  std::optional<double> at;
  std::string field = "displacement";
  std::string probe; ///< when given, histories
  std::string node;
  std::string group;
  bool norms = false; ///< over the whole mesh; also when neither node nor group is given
  std::filesystem::path output;
  std::optional<double> tolerance;
};
int compare(const CompareArguments& arguments);

/// What is drawn: histories, the points of a contact zone, or a field on the deformed bodies.
struct PlotArguments {
  std::vector<std::filesystem::path> runs;
  std::vector<std::string> history; ///< empty, as `line` and `field`: every probe
  std::string against;
  std::string line; ///< a zone, or a zone and a column of its points
  std::string along;
  std::string field;
  std::vector<double> at;
  double scale = 1;
  std::vector<double> view;  ///< azimuth and elevation [degrees]
  std::vector<double> range; ///< of the colours
  std::string reference;     ///< an expression
  std::filesystem::path output;
  int width = 800;
  std::optional<int> height;
};
int plot(const PlotArguments& arguments);

struct ReportArguments {
  std::vector<std::filesystem::path> runs; ///< one, or two side by side
  std::filesystem::path output;
};
int report(const ReportArguments& arguments);

struct InfoArguments {
  std::filesystem::path file;
  std::string mesh_name;
};
int info(const InfoArguments& arguments);

struct MeshArguments {
  std::filesystem::path source; ///< a deck or a mesh file
  std::filesystem::path output;
  std::vector<std::string> settings;
  std::string convert;
  int refine = 1;
  std::vector<std::string> groups; ///< "NAME={normal: [0, 0, 1]}"
};
int mesh(const MeshArguments& arguments);

/// A Code_Aster study. Numbers are handed on as they are written; empty: not given.
struct AsterArguments {
  std::filesystem::path study; ///< .comm or .export
  std::filesystem::path output;
  std::vector<std::string> files; ///< "UNIT=PATH"
  std::string time;
  std::string memory;
  std::string regression_tolerance;
  bool check = false;
};
/// Ends in another program; returns only by exceptions.
int aster(const AsterArguments& arguments);

struct NewArguments {
  std::string name; ///< empty: list the templates
  std::filesystem::path output;
};
int new_deck(const NewArguments& arguments);
/// Names of the decks that `new` writes.
std::vector<std::string> template_names();

/// What completions and the build ask for.
struct ShellArguments {
  std::filesystem::path folder; ///< laid out as /usr/share
  std::filesystem::path deck;
  std::vector<std::filesystem::path> runs;
};
int write_shell_files(const ShellArguments& arguments);
int print_run_names(const ShellArguments& arguments);
int print_quantity_names(const ShellArguments& arguments);

int list();
int schema();

} // namespace rubato::app
