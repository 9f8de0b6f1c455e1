// SPDX-License-Identifier: LGPL-3.0-or-later
/// The model of a deck.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"

#include <string_view>
#include <vector>

namespace rubato::test {

/// The model of a deck's first run. Throws InputError with the places of the deck.
inline model::Model model_of(std::string_view deck, const std::vector<deck::Setting>& changes = {}) {
  const auto read = deck::parse_deck(deck, "deck.yaml", changes);
  try {
    return model::build_model(read.runs.front());
  } catch (const InputError& error) {
    throw read.places.front().located(error);
  }
}

} // namespace rubato::test
