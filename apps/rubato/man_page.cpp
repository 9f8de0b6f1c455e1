// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/version.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command_line.hpp"
#include "shell_files.hpp"

namespace rubato::app {
namespace {

/// Text as man's macros show it: a hyphen is a minus, a backslash itself.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text)
    result += letter == '\\'  ? std::string("\\e")
              : letter == '-' ? std::string("\\-")
                              : std::string(1, letter);
  return result.starts_with('.') || result.starts_with('\'') ? "\\&" + result : result;
}

std::string heading(const std::string& name) {
  std::string upper = name;
  for (auto& letter : upper)
    letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return fmt::format(".TH {} 1 \"\" \"rubato {}\" \"User commands\"\n", escaped(upper), version);
}

std::string names_of(const Argument& argument) {
  if (argument.names.empty())
    return fmt::format("\\fI{}\\fR", escaped(argument.name));
  std::vector<std::string> names;
  for (const auto& name : argument.names)
    names.push_back(fmt::format("\\fB{}\\fR", escaped(name)));
  const auto value = argument.kind.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped(argument.kind));
  return fmt::format("{}{}", fmt::join(names, ", "), value);
}

std::string options_text(const CLI::App& command) {
  std::string text = ".SH OPTIONS\n";
  for (const auto& argument : arguments_of(command))
    text += fmt::format(".TP\n{}\n{}\n", names_of(argument), escaped(argument.meaning));
  return text;
}

std::string synopsis(const CLI::App& command) {
  std::string positional;
  for (const auto& argument : arguments_of(command)) {
    const auto name = fmt::format("\\fI{}\\fR{}", escaped(argument.name), argument.repeated ? " ..." : "");
    if (argument.names.empty())
      positional += argument.required ? " " + name : " [" + name + "]";
  }
  return fmt::format(".SH SYNOPSIS\n\\fBrubato {}\\fR [options]{}\n", escaped(command.get_name()),
                     positional);
}

std::string exit_codes(const CLI::App& program) {
  return fmt::format(".SH EXIT STATUS\n{}\n", escaped(program.get_footer()));
}

} // namespace

std::string man_page(const CLI::App& program) {
  auto text = heading("rubato");
  text += fmt::format(".SH NAME\nrubato \\- {}\n",
                      escaped(program.get_description().substr(std::string("rubato: ").size())));
  text += ".SH SYNOPSIS\n\\fBrubato\\fR \\fIcommand\\fR [options]\n.SH COMMANDS\n";
  std::vector<std::string> pages;
  for (const auto* command : shown_commands(program)) {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", escaped(command->get_name()),
                        escaped(command->get_description()));
    pages.push_back(fmt::format("\\fBrubato\\-{}\\fR(1)", escaped(command->get_name())));
  }
  text += options_text(program) + exit_codes(program);
  text += fmt::format(".SH SEE ALSO\n.nh\n{}\n", fmt::join(pages, ", ")); // names stay whole
  return text;
}

std::string man_page(const CLI::App& program, const CLI::App& command) {
  const auto name = fmt::format("rubato-{}", command.get_name());
  return heading(name) +
         fmt::format(".SH NAME\n{} \\- {}\n", escaped(name), escaped(command.get_description())) +
         synopsis(command) + options_text(command) + exit_codes(program) +
         ".SH SEE ALSO\n\\fBrubato\\fR(1)\n";
}

} // namespace rubato::app
