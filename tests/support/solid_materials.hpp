// SPDX-License-Identifier: LGPL-3.0-or-later
/// Studies of decks whose first material is made another one.
#pragma once

#include "rubato/deck/read.hpp"

#include <string_view>

namespace rubato::test {

inline study::Study study_of(std::string_view deck) {
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

/// von Mises' plasticity with R = yield_stress + modulus p.
inline void make_plastic(study::Material& material, double yield_stress, double modulus,
                         study::StrainKind strain = study::StrainKind::small) {
  material.law = study::LawKind::plastic;
  material.plasticity.yield_stress = yield_stress;
  material.plasticity.modulus = modulus;
  material.strain = strain;
}

} // namespace rubato::test
