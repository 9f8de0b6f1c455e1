// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/core/writing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "templates.hpp"
#include <algorithm>
#include <fstream>

namespace rubato::app {
namespace {

/// The first line of a template says in a sentence what it is.
std::string_view sentence_of(std::string_view deck) {
  deck.remove_prefix(std::string_view("# ").size());
  return deck.substr(0, deck.find('\n'));
}

const Template& template_named(const std::string& name) {
  const auto found = std::ranges::find(templates(), name, &Template::name);
  if (found != templates().end())
    return *found;
  const auto nearest = nearest_word(name, template_names());
  throw InputError(fmt::format("found '{}', expected one of {}{}", name, fmt::join(template_names(), ", "),
                               nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
}

int list_templates() {
  for (const auto& entry : templates())
    fmt::print("  {:<12} {}\n", entry.name, sentence_of(entry.deck));
  return done;
}

} // namespace

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const auto& entry : templates())
    names.emplace_back(entry.name);
  return names;
}

int new_deck(const NewArguments& arguments) {
  if (arguments.name.empty())
    return list_templates();
  const auto& [name, deck] = template_named(arguments.name);
  if (arguments.output == "-") {
    fmt::print("{}", deck);
    return done;
  }
  const auto path =
      arguments.output.empty() ? std::filesystem::path(fmt::format("{}.yaml", name)) : arguments.output;
  if (std::filesystem::exists(path))
    throw InputError("there is a file already, expected -o with another name", {path.string()});
  std::ofstream file(path, std::ios::binary);
  if (!file)
    throw InputError("the file cannot be written", {path.string()});
  file << deck;
  finish_writing(file, path);
  fmt::print("{}: {}\nrubato run {}\n", path.string(), sentence_of(deck), path.string());
  return done;
}

} // namespace rubato::app
