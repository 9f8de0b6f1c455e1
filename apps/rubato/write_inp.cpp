// SPDX-License-Identifier: LGPL-3.0-or-later
#include "write_inp.hpp"

#include "rubato/ccx/write.hpp"
#include "rubato/core/writing.hpp"

#include <fmt/format.h>

#include "read_deck.hpp"
#include <fstream>

namespace rubato::app {
namespace {

std::optional<ccx::Frequencies> frequencies_of(const StepsDeck& steps, const study::Study& study,
                                               const std::optional<int>& wanted) {
  const auto step = steps.modes.find(study.name);
  if (step == steps.modes.end() && !wanted)
    return std::nullopt;
  ccx::Frequencies modes;
  if (step != steps.modes.end()) {
    modes.number = step->second.number.value_or(modes.number);
    modes.lowest = step->second.lowest;
    modes.highest = step->second.highest;
  }
  modes.number = wanted.value_or(modes.number);
  return modes;
}

ccx::InputFile input_of(const StepsDeck& steps, const std::optional<int>& modes) {
  ccx::InputFile file;
  for (std::size_t i = 0; i < steps.deck.runs.size(); ++i) {
    const auto& study = steps.deck.runs[i];
    try {
      file.add(study, frequencies_of(steps, study, modes));
    } catch (const InputError& error) {
      throw steps.deck.places[i].located(error);
    }
    if (modes) // those of the first run, as of `rubato modes`
      break;
  }
  return file;
}

} // namespace

void write_inp(const DeckArguments& arguments) {
  if (arguments.modes && *arguments.modes < 1)
    throw InputError(fmt::format("--modes: found {}, expected 1 or more", *arguments.modes));
  const auto steps = read_steps_deck(arguments.source, arguments.settings, arguments.only);
  const auto file = input_of(steps, arguments.modes);
  for (const auto& note : steps.deck.notes)
    fmt::print(stderr, "{}\n", note);
  for (const auto& note : file.notes())
    fmt::print(stderr, "{}\n", note);
  const auto text = file.text();
  write_whole(arguments.output, [&](const std::filesystem::path& beside) {
    std::ofstream stream(beside, std::ios::binary);
    if (!stream)
      throw InputError(
          fmt::format("file '{}' cannot be written: is there such a folder, and may you write into it?",
                      arguments.output.string()));
    stream << text;
    finish_writing(stream, arguments.output);
  });
}

} // namespace rubato::app
