// SPDX-License-Identifier: LGPL-3.0-or-later
#include "shell_files.hpp"

#include "rubato/core/writing.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "command_line.hpp"
#include "read_deck.hpp"
#include <fstream>
#include <sstream>

namespace rubato::app {
namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  finish_writing(file, path);
}

Argument argument_of(const CLI::Option& option) {
  Argument argument;
  for (const auto& letter : option.get_snames())
    argument.names.push_back("-" + letter);
  for (const auto& word : option.get_lnames())
    argument.names.push_back("--" + word);
  argument.name = option.get_positional() ? option.get_name() : "";
  argument.kind = option.get_items_expected_max() == 0 ? "" : option.get_type_name();
  argument.meaning = option.get_description();
  argument.required = option.get_required();
  argument.repeated = option.get_positional() && option.get_items_expected_max() > 1;
  return argument;
}

} // namespace

std::vector<Argument> arguments_of(const CLI::App& command) {
  std::vector<Argument> options;
  std::vector<Argument> positional;
  for (const auto* option : command.get_options())
    (option->get_positional() ? positional : options).push_back(argument_of(*option));
  options.insert(options.end(), positional.begin(), positional.end());
  return options;
}

std::vector<std::string> words_of_kind(const std::string& kind) {
  std::vector<std::string> words;
  if (kind.find('|') == std::string::npos)
    return words;
  std::istringstream stream(kind);
  for (std::string word; std::getline(stream, word, '|');)
    words.push_back(word);
  return words;
}

int write_shell_files(const ShellArguments& shell) {
  Arguments arguments;
  CLI::App program(about, "rubato");
  declare(program, arguments);
  const auto pages = shell.folder / "man" / "man1";
  write(pages / "rubato.1", man_page(program));
  for (const auto* command : shown_commands(program))
    write(pages / fmt::format("rubato-{}.1", command->get_name()), man_page(program, *command));
  write(shell.folder / "bash-completion" / "completions" / "rubato", bash_completion(program));
  write(shell.folder / "zsh" / "site-functions" / "_rubato", zsh_completion(program));
  write(shell.folder / "fish" / "vendor_completions.d" / "rubato.fish", fish_completion(program));
  return done;
}

int print_run_names(const ShellArguments& shell) {
  for (const auto& run : read_deck(shell.deck).runs)
    fmt::print("{}\n", run.name);
  return done;
}

} // namespace rubato::app
