// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mesh_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command_line.hpp"
#include "shell_files.hpp"
#include <algorithm>
#include <string_view>

namespace rubato::app {
namespace {

constexpr auto deck_endings = "yaml|yml|inp";
constexpr auto yaml_endings = "yaml|yml";

/// "med|msh": of the mesh files that are read.
std::string mesh_endings() {
  std::string endings;
  for (const auto& format : rubato::mesh::all_formats())
    if (format.read != nullptr)
      for (const auto ending : format.endings)
        endings += fmt::format("{}{}", endings.empty() ? "" : "|", ending.substr(1));
  return endings;
}

/// The endings of files of a kind, between bars; empty of other kinds.
std::string endings_of(const std::string& kind) {
  if (kind == kind::deck || kind == kind::deck_or_folder)
    return deck_endings;
  if (kind == kind::mesh)
    return mesh_endings();
  if (kind == kind::deck_or_mesh)
    return fmt::format("{}|{}", yaml_endings, mesh_endings()); // .inp is among these
  if (kind == kind::study)
    return "comm|export";
  return {};
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const auto& argument : arguments_of(command))
    names.insert(names.end(), argument.names.begin(), argument.names.end());
  return names;
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const auto* command : shown_commands(program))
    names.push_back(command->get_name());
  return names;
}

std::string replaced(std::string text, std::string_view old, std::string_view by) {
  for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + by.size()))
    text.replace(at, old.size(), by);
  return text;
}

// ---- bash ------------------------------------------------------------------------------------------------

/// What bash offers for a value of a kind.
std::string bash_value(const std::string& kind) {
  if (const auto words = words_of_kind(kind); !words.empty())
    return fmt::format("_rubato_words '{}'", fmt::join(words, " "));
  if (kind == kind::runs)
    return "_rubato_runs";
  if (kind == kind::quantity || kind == kind::quantities)
    return "_rubato_quantities";
  if (kind == kind::folder)
    return "_rubato_files ''";
  if (kind == kind::file)
    return "_rubato_files '*'";
  if (const auto endings = endings_of(kind); !endings.empty())
    return fmt::format("_rubato_files '*.@({})'", endings);
  return ":";
}

/// Branches of bash's `case` for the values of one command's arguments.
struct BashCases {
  std::string options;    ///< by command and option
  std::string positional; ///< by command and place
};

BashCases bash_cases(const CLI::App& command) {
  BashCases cases;
  int place = 0;
  for (const auto& argument : arguments_of(command)) {
    if (argument.names.empty())
      cases.positional +=
          fmt::format("    '{} '{}) {} ;;\n", command.get_name(),
                      argument.repeated ? "*" : std::to_string(place++), bash_value(argument.kind));
    else if (!argument.kind.empty())
      cases.options += fmt::format("    '{} {}') {}; return ;;\n", command.get_name(),
                                   fmt::join(argument.names, fmt::format("'|'{} ", command.get_name())),
                                   bash_value(argument.kind));
  }
  return cases;
}

constexpr std::string_view bash_frame = R"sh(# Completion of rubato for bash, made by rubato itself.

_rubato_words() {
  COMPREPLY=($(compgen -W "$1" -- "$current"))
}

# Folders, and files that match a pattern.
_rubato_files() {
  local name
  compopt -o filenames 2>/dev/null
  while IFS= read -r name; do
    if [[ -d $name ]] || [[ -n $1 && $name == $1 ]]; then
      COMPREPLY+=("$name")
    fi
  done < <(compgen -f -- "$current")
}

# Names that rubato prints for these arguments, after the last comma.
_rubato_names() {
  local before=""
  [[ $current == *,* ]] && before=${current%,*},
  COMPREPLY=($(compgen -P "$before" -W "$("${COMP_WORDS[0]}" "$@" 2>/dev/null)" -- "${current##*,}"))
}

# Names of runs of the deck on the command line.
_rubato_runs() {
  local word deck
  for word in "${COMP_WORDS[@]}"; do
    [[ $word == *.@(@deck_endings@) ]] && deck=$word
  done
  [[ -n $deck ]] && _rubato_names run-names "$deck"
}

# What the runs on the command line have histories of.
_rubato_quantities() {
  local word folders=()
  for word in "${COMP_WORDS[@]:2}"; do
    [[ -d $word ]] && folders+=("$word")
  done
  ((${#folders[@]} > 0)) && _rubato_names quantity-names "${folders[@]}"
}

_rubato() {
  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command=${COMP_WORDS[1]} place=0 i
  COMPREPLY=()
  if [[ $current == = ]]; then
    current=""
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  if ((COMP_CWORD == 1)); then
    _rubato_words '@commands@ @options@'
    return
  fi
  case "$command $before" in
@value_cases@  esac
  if [[ $current == -* ]]; then
    case $command in
@option_cases@    esac
    return
  fi
  for ((i = 2; i < COMP_CWORD; ++i)); do
    case "$command ${COMP_WORDS[i]}" in
@skip_cases@      *' -'?*) ;;
      *) ((++place)) ;;
    esac
  done
  case "$command $place" in
@positional_cases@  esac
}

complete -F _rubato rubato
)sh";

// ---- zsh -------------------------------------------------------------------------------------------------

/// A text in an entry of _arguments, between single quotes.
std::string zsh_escaped(std::string text) {
  for (const auto* sign : {"\\", "[", "]", ":"})
    text = replaced(std::move(text), sign, fmt::format("\\{}", sign));
  return replaced(std::move(text), "'", "'\\''");
}

std::string zsh_value(const std::string& kind) {
  if (const auto words = words_of_kind(kind); !words.empty())
    return fmt::format("({})", fmt::join(words, " "));
  if (kind == kind::runs)
    return "_rubato_runs";
  if (kind == kind::quantity || kind == kind::quantities)
    return "_rubato_quantities";
  if (kind == kind::folder)
    return "_files -/";
  if (kind == kind::file)
    return "_files";
  if (const auto endings = endings_of(kind); !endings.empty())
    return fmt::format("_files -g \"*.({})(-.)\"", endings);
  return " ";
}

std::string zsh_argument(const Argument& argument) {
  const auto value =
      argument.kind.empty()
          ? ""
          : fmt::format(":{}:{}", zsh_escaped(words_of_kind(argument.kind).empty() ? argument.kind : "word"),
                        replaced(zsh_value(argument.kind), "'", "'\\''"));
  if (argument.names.empty())
    return fmt::format("'{}:{}:{}'",
                       argument.repeated   ? "*"
                       : argument.required ? ""
                                           : ":",
                       zsh_escaped(argument.meaning), replaced(zsh_value(argument.kind), "'", "'\\''"));
  if (argument.names.size() == 1)
    return fmt::format("'{}{}[{}]{}'", argument.kind == kind::setting ? "*" : "", argument.names.front(),
                       zsh_escaped(argument.meaning), value);
  return fmt::format("'({0})'{{{1}}}'[{2}]{3}'", fmt::join(argument.names, " "),
                     fmt::join(argument.names, ","), zsh_escaped(argument.meaning), value);
}

constexpr std::string_view zsh_frame = R"sh(#compdef rubato
# Completion of rubato for zsh, made by rubato itself.

_rubato_runs() {
  local deck=${words[(r)*.(@deck_endings@)]}
  [[ -n $deck ]] || return
  local -a names=(${(f)"$(rubato run-names $deck 2>/dev/null)"})
  _values -s , run $names
}

_rubato_quantities() {
  local word
  local -a folders
  for word in $words; do
    [[ -d $word ]] && folders+=($word)
  done
  (($#folders)) || return
  local -a names=(${(f)"$(rubato quantity-names $folders 2>/dev/null)"})
  _values -s , quantity $names
}

_rubato() {
  local context state state_descr line
  local -A opt_args
  _arguments -C @options@ '1:command:->command' '*::argument:->arguments'
  case $state in
    command)
      local -a commands=(
@commands@      )
      _describe command commands
      ;;
    arguments)
      case $words[1] in
@cases@      esac
      ;;
  esac
}

_rubato "$@"
)sh";

// ---- fish ------------------------------------------------------------------------------------------------

std::string fish_escaped(std::string text) {
  text = replaced(std::move(text), "\\", "\\\\");
  return replaced(std::move(text), "'", "\\'");
}

/// The words that fish offers for a value of a kind, as an argument of `complete`.
std::string fish_value(const std::string& kind) {
  if (const auto words = words_of_kind(kind); !words.empty())
    return fmt::format(" -x -a '{}'", fmt::join(words, " "));
  if (kind == kind::runs)
    return " -x -a '(__rubato_runs)'";
  if (kind == kind::quantity || kind == kind::quantities)
    return " -x -a '(__rubato_quantities)'";
  if (kind == kind::folder)
    return " -x -a '(__fish_complete_directories)'";
  if (kind == kind::file)
    return " -r -F";
  if (const auto endings = endings_of(kind); !endings.empty())
    return fmt::format(" -x -a '(__rubato_files \"{}\")'", endings);
  return " -x";
}

std::string fish_argument(const std::string& command, const Argument& argument) {
  auto line = fmt::format("complete -c rubato -n '__fish_seen_subcommand_from {}'", command);
  for (const auto& name : argument.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!argument.kind.empty())
    line += fish_value(argument.kind);
  if (!argument.names.empty())
    line += fmt::format(" -d '{}'", fish_escaped(argument.meaning));
  return line + "\n";
}

constexpr std::string_view fish_frame = R"sh(# Completion of rubato for fish, made by rubato itself.

# Names of runs of the deck on the command line, after those that are written already.
function __rubato_runs
    set -l deck (commandline -opc | string match -r '.*\.(?:@deck_endings@)$')
    set -l before (commandline -ct | string match -r '^.*,')
    test -n "$deck[1]"; and rubato run-names $deck[1] 2>/dev/null | string replace -r '^' "$before"
end

# What the runs on the command line have histories of, likewise.
function __rubato_quantities
    set -l folders
    for word in (commandline -opc)[3..-1]
        test -d $word; and set -a folders $word
    end
    set -l before (commandline -ct | string match -r '^.*,')
    test -n "$folders[1]"; and rubato quantity-names $folders 2>/dev/null | string replace -r '^' "$before"
end

# Folders, and files with one of these endings. A command that is none has files for arguments.
function __rubato_files
    complete -C "__rubato_no_command "(commandline -ct) | string match -r -- "^.*(?:\.(?:$argv[1])|/)\$"
end

complete -c rubato -f
)sh";

} // namespace

std::string bash_completion(const CLI::App& program) {
  std::string values;
  std::string options;
  std::string skipped;
  std::string positional;
  for (const auto* command : shown_commands(program)) {
    const auto cases = bash_cases(*command);
    values += cases.options;
    positional += cases.positional;
    options += fmt::format("      {}) _rubato_words '{}' ;;\n", command->get_name(),
                           fmt::join(option_names(*command), " "));
    for (const auto& argument : arguments_of(*command))
      if (!argument.names.empty() && !argument.kind.empty())
        for (const auto& name : argument.names)
          skipped += fmt::format("      '{} {}') ((++i)) ;;\n", command->get_name(), name);
  }
  std::string text(bash_frame);
  text = replaced(text, "@commands@", fmt::format("{}", fmt::join(command_names(program), " ")));
  text = replaced(text, "@options@", fmt::format("{}", fmt::join(option_names(program), " ")));
  text = replaced(text, "@value_cases@", values);
  text = replaced(text, "@option_cases@", options);
  text = replaced(text, "@skip_cases@", skipped);
  text = replaced(text, "@positional_cases@", positional);
  return replaced(text, "@deck_endings@", deck_endings);
}

std::string zsh_completion(const CLI::App& program) {
  std::string options;
  std::string commands;
  std::string cases;
  for (const auto& argument : arguments_of(program))
    options += (options.empty() ? "" : " ") + zsh_argument(argument);
  for (const auto* command : shown_commands(program)) {
    commands +=
        fmt::format("        '{}:{}'\n", command->get_name(), zsh_escaped(command->get_description()));
    cases += fmt::format("        {})\n          _arguments \\\n", command->get_name());
    const auto arguments = arguments_of(*command);
    for (std::size_t i = 0; i < arguments.size(); ++i)
      cases += fmt::format("            {}{}\n", zsh_argument(arguments[i]),
                           i + 1 < arguments.size() ? " \\" : "");
    cases += "          ;;\n";
  }
  std::string text(zsh_frame);
  text = replaced(text, "@options@", options);
  text = replaced(text, "@commands@", commands);
  text = replaced(text, "@cases@", cases);
  return replaced(text, "@deck_endings@", deck_endings);
}

std::string fish_completion(const CLI::App& program) {
  auto text = replaced(std::string(fish_frame), "@deck_endings@", deck_endings);
  for (const auto& argument : arguments_of(program))
    text += replaced(fish_argument("", argument), "__fish_seen_subcommand_from ", "__fish_use_subcommand");
  for (const auto* command : shown_commands(program)) {
    text += fmt::format("complete -c rubato -n __fish_use_subcommand -a {} -d '{}'\n", command->get_name(),
                        fish_escaped(command->get_description()));
    for (const auto& argument : arguments_of(*command))
      text += fish_argument(command->get_name(), argument);
  }
  return text;
}

} // namespace rubato::app
