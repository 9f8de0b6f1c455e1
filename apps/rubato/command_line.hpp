// SPDX-License-Identifier: LGPL-3.0-or-later
/// The command line: subcommands, options, and what they are for. Help, man pages and completions are all
/// made of it.
#pragma once

#include "commands.hpp"
#include <functional>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace rubato::app {

/// What the command line says; the subcommand that was chosen reads its part.
struct Arguments {
  RunArguments run;
  ModesArguments modes;
  DeckArguments deck;
  CheckArguments check;
  CompareArguments compare;
  PlotArguments plot;
  ReportArguments report;
  InfoArguments info;
  MeshArguments mesh;
  AsterArguments aster;
  NewArguments new_deck;
  ShellArguments shell;
  std::function<int()> work;
};

/// Names of the kinds of values, as help shows them; completions offer files by them. A kind with bars is a
/// list of words.
namespace kind {
inline constexpr auto deck = "DECK";
inline constexpr auto folder = "FOLDER";
inline constexpr auto deck_or_folder = "DECK_OR_FOLDER";
inline constexpr auto mesh = "MESH";
inline constexpr auto deck_or_mesh = "DECK_OR_MESH";
inline constexpr auto file = "FILE";
inline constexpr auto runs = "RUN,...";
inline constexpr auto setting = "PATH=VALUE";
inline constexpr auto name = "NAME";
inline constexpr auto group = "NAME={...}";
inline constexpr auto number = "NUMBER";
inline constexpr auto numbers = "NUMBER,...";
inline constexpr auto quantity = "QUANTITY";
inline constexpr auto quantities = "QUANTITY,...";
inline constexpr auto expression = "EXPRESSION";
inline constexpr auto study = "STUDY";
inline constexpr auto unit = "UNIT=FILE";
} // namespace kind

inline constexpr auto about = "rubato: how elastic bodies move, touch, rub and part";

/// The subcommands that help shows, in its order.
std::vector<const CLI::App*> shown_commands(const CLI::App& program);

/// Declares all of it. `arguments` must outlive the program's parsing.
void declare(CLI::App& program, Arguments& arguments);

} // namespace rubato::app
