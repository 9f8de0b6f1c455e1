// SPDX-License-Identifier: LGPL-3.0-or-later
// What materials have beside the numbers of their laws.
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

namespace rubato::deck::grammar {
namespace {

Forms points() {
  return list(list(number(), 2, 2), 1);
}

/// Beside the numbers of the row.
void add_tangent_modulus(std::vector<Key>& keys) {
  keys.push_back({"tangent_modulus",
                  "instead of modulus: slope of stress over strain in tension [force/length²]",
                  number(study::bounds::tangent_modulus)});
}

Forms hardening() {
  std::vector<Key> keys;
  for (const auto& row : study::hardenings) {
    auto numbers = numbers_of(std::span(&row, 1));
    for (auto& number : numbers)
      number.required =
          std::ranges::find(row.numbers, number.name, &study::Number<study::Plasticity>::key)->required;
    if (row.kind == study::HardeningKind::linear)
      add_tangent_modulus(numbers);
    keys.push_back(
        {std::string(row.name), std::string(row.summary),
         study::is_table(row.kind) ? points() : map(std::string(row.summary), std::move(numbers))});
  }
  return map("how the yield stress grows, one of these", std::move(keys));
}

Forms kinematic() {
  const auto one =
      map("a back stress, by which the yield surface moves",
          {{"modulus", "C of ⅔ C α [force/length²]", number(study::bounds::back_stress), true},
           {"recall", "γ of the recall γ α; 0 when not given", number(study::bounds::back_stress)}});
  return either(one, list(one, 1, study::most_back_stresses));
}

/// One form for both laws, as a deck that no run reads is judged without its law.
Forms terms() {
  return list(
      map("a term of a series",
          {{"shear", "prony: shear modulus that relaxes; ogden: part of the shear modulus [force/length²]",
            number(), true},
           {"time", "prony: in which it relaxes [time]", number(study::bounds::relaxation_time)},
           {"exponent", "ogden: of the principal stretches, not 0", number()}}),
      1);
}

} // namespace

std::vector<Key> material_words() {
  return {{"hardening", "plastic: how the yield stress grows with plastic strain", hardening()},
          {"kinematic", "plastic: how the yield surface moves; not at all when not given", kinematic()},
          {"terms", "prony, ogden: the terms of the series", terms()},
          {"volumetric", "hyperelastic laws: energy of changes of volume; logarithmic when not given",
           word_of(study::volume_energy_words)},
          {"strain",
           "strain that the law sees; small, or green_lagrange of hyperelastic laws, when not given",
           word_of(study::strain_words)},
          {"formulation",
           "how cells are integrated; when not given, mean_dilatation of plastic and hyperelastic "
           "cells, but not of TRIA3, TETRA4 and pyramids and not in plane_stress, else full",
           word_of(study::formulation_words)}};
}

} // namespace rubato::deck::grammar
