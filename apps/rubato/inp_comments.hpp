// SPDX-License-Identifier: LGPL-3.0-or-later
/// Comments of .inp files in the decks that are written of them.
#pragma once

#include "rubato/deck/read.hpp"

#include <filesystem>
#include <string>

namespace rubato::app {

/// The text of a deck (deck_text of the runs) with the comments of the .inp file that it comes from. Comments
/// before and within a keyword's block are before the entry of the deck that the block gives. Those of a step
/// are before its run, all others at the head.
std::string with_comments(const std::string& text, const deck::Deck& deck, const std::filesystem::path& inp);

} // namespace rubato::app
