// SPDX-License-Identifier: LGPL-3.0-or-later
/// Man pages and completions, made of the declared command line, so that neither can differ from --help.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace rubato::app {

/// One argument of a command as pages and completions need it.
struct Argument {
  std::vector<std::string> names; ///< "-o", "--output"; empty of a positional one
  std::string name;               ///< of a positional one
  std::string kind;               ///< "FOLDER"; empty of a flag
  std::string meaning;
  bool required = false;
  bool repeated = false; ///< a positional one that takes all that follow
};

/// Options first, --help among them, then positional arguments in their order.
std::vector<Argument> arguments_of(const CLI::App& command);

/// The words of a kind that is a list of them, "linear|quadratic"; none of other kinds.
std::vector<std::string> words_of_kind(const std::string& kind);

/// The page of the whole program, or of one subcommand, in man's macros.
std::string man_page(const CLI::App& program);
std::string man_page(const CLI::App& program, const CLI::App& command);

std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);
std::string fish_completion(const CLI::App& program);

} // namespace rubato::app
