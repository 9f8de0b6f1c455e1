// SPDX-License-Identifier: LGPL-3.0-or-later
/// Decks of input files of Abaqus and CalculiX.
#pragma once

#include "rubato/inp/read.hpp"

#include "read_deck.hpp"

namespace rubato::app {

/// The steps of the file as runs of a deck, with changes. Throws as inp::read_input does.
StepsDeck read_inp(const std::filesystem::path& file, inp::Purpose purpose,
                   std::span<const deck::Setting> changes, std::span<const std::string> only);

} // namespace rubato::app
