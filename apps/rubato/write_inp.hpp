// SPDX-License-Identifier: LGPL-3.0-or-later
/// Decks as input files of CalculiX.
#pragma once

#include "commands.hpp"

namespace rubato::app {

/// Writes the runs of the source as the steps of an input file of CalculiX; nothing where a key has no
/// counterpart there. Throws InputError with each of these keys, located in the source.
void write_inp(const DeckArguments& arguments);

} // namespace rubato::app
