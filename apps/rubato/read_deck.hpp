// SPDX-License-Identifier: LGPL-3.0-or-later
/// Decks as the command line names them.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/inp/read.hpp"

#include <filesystem>
#include <map>
#include <span>
#include <string>

namespace rubato::app {

/// Whether the argument is "-", which stands for standard input.
bool is_standard_input(const std::filesystem::path& argument);

/// Whether the argument is an input file of Abaqus or CalculiX, by its ending.
bool is_inp(const std::filesystem::path& argument);

/// Reads a deck from a file or from standard input, whose mesh files are then relative to the current folder,
/// or the steps of an .inp file as runs of a deck. `settings`: "path.to.key=value". Throws as deck::read_deck
/// and inp::read_input do.
deck::Deck read_deck(const std::filesystem::path& argument, std::span<const std::string> settings = {},
                     std::span<const std::string> only = {});

/// Runs of a deck, or steps of an .inp file, some of which may be natural modes.
struct StepsDeck {
  deck::Deck deck;
  std::map<std::string, inp::ModesAsked> modes; ///< runs of an .inp file that are natural modes, by name
};
/// Every step of an .inp file; read_deck leaves natural modes out where there are other steps.
StepsDeck read_steps_deck(const std::filesystem::path& argument, std::span<const std::string> settings = {},
                          std::span<const std::string> only = {});
/// Returns only the natural modes of an .inp file.
StepsDeck read_modes_deck(const std::filesystem::path& argument, std::span<const std::string> settings,
                          std::span<const std::string> only);
/// The deck without runs that are natural modes.
deck::Deck without_modes(const StepsDeck& steps);

/// The runs as the text of one deck, whose mesh files are those named in the studies.
std::string deck_text(std::span<const study::Study> runs);

} // namespace rubato::app
