// SPDX-License-Identifier: LGPL-3.0-or-later
/// Studies of decks whose first material is made another one.
#pragma once

#include "rubato/study/study.hpp"

#include "support/model_of.hpp"

namespace rubato::test {

/// von Mises' plasticity with R = yield_stress + modulus p.
inline void make_plastic(study::Material& material, double yield_stress, double modulus,
                         study::StrainKind strain = study::StrainKind::small) {
  material.law = study::LawKind::plastic;
  material.plasticity.yield_stress = yield_stress;
  material.plasticity.modulus = modulus;
  material.strain = strain;
}

} // namespace rubato::test
