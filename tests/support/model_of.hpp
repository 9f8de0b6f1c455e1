// SPDX-License-Identifier: LGPL-3.0-or-later
/// The model of a deck.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"

#include <string_view>
#include <vector>

namespace rubato::test {

/// Of its first run.
inline model::Model model_of(std::string_view deck, const std::vector<deck::Setting>& changes = {}) {
  return model::build_model(deck::parse_deck(deck, "deck.yaml", changes).runs.front());
}

} // namespace rubato::test
