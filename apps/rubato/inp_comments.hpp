// SPDX-License-Identifier: LGPL-3.0-or-later
/// Comments of .inp files in the decks that are written of them.
#pragma once

#include "rubato/deck/read.hpp"

#include <filesystem>
#include <string>

namespace rubato::app {

/// The text of a deck (deck_text of the runs) with the comments of the .inp file that it comes from. Lines
/// before and within a keyword's block become comments before the entry of the deck that the block gives, or
/// before the run that a step is; others are at the head.
std::string with_comments(const std::string& text, const deck::Deck& deck, const std::filesystem::path& inp);

} // namespace rubato::app
