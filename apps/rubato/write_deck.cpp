// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/writing.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "inp_comments.hpp"
#include "read_deck.hpp"
#include "write_inp.hpp"
#include <fstream>

namespace rubato::app {

int write_deck(const DeckArguments& arguments) {
  if (is_inp(arguments.output)) {
    write_inp(arguments);
    return done;
  }
  if (arguments.modes)
    throw InputError(
        "--modes: found it without an .inp file to write, expected -o FILE.inp: a deck has no step of "
        "natural modes");
  auto deck = read_deck(arguments.source, arguments.settings, arguments.only);
  const bool to_file = !arguments.output.empty() && !is_standard_input(arguments.output);
  const auto folder =
      to_file ? std::filesystem::absolute(arguments.output).parent_path() : std::filesystem::current_path();
  for (auto& study : deck.runs)
    if (!study.mesh.file.empty())
      study.mesh.file = std::filesystem::absolute(study.mesh.file).lexically_proximate(folder).string();
  auto text = deck_text(deck.runs);
  if (is_inp(arguments.source))
    text = with_comments(text, deck, arguments.source);
  for (const auto& note : deck.notes)
    fmt::print(stderr, "{}\n", note);
  if (!to_file) {
    fmt::print("{}", text);
    return done;
  }
  write_whole(arguments.output, [&](const std::filesystem::path& beside) {
    std::ofstream stream(beside, std::ios::binary);
    if (!stream)
      throw InputError(
          fmt::format("file '{}' cannot be written: is there such a folder, and may you write into it?",
                      arguments.output.string()));
    stream << text;
    finish_writing(stream, arguments.output);
  });
  return done;
}

} // namespace rubato::app
