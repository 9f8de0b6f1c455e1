// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace rubato::deck {

/// JSON Schema (draft 7) of a deck, for editors and validators: keys with what they mean, words, kinds of
/// values and bounds of numbers. It knows no rule about several values together and nothing of the mesh, and
/// refuses no deck that parse_deck takes. A validator must read the deck as YAML 1.2, in which `on` is a
/// word.
std::string schema();

} // namespace rubato::deck
