// SPDX-License-Identifier: LGPL-3.0-or-later
/// Decks as the command line names them.
#pragma once

#include "rubato/deck/read.hpp"

#include <filesystem>
#include <span>
#include <string>

namespace rubato::app {

/// Whether the argument is "-", which stands for standard input.
bool is_standard_input(const std::filesystem::path& argument);

/// Reads a deck from a file or from standard input, whose mesh files are then relative to the current folder.
/// `settings`: "path.to.key=value". Throws as deck::read_deck does.
deck::Deck read_deck(const std::filesystem::path& argument, std::span<const std::string> settings = {},
                     std::span<const std::string> only = {});

} // namespace rubato::app
