// SPDX-License-Identifier: LGPL-3.0-or-later
// What laws have that are no plain numbers: hardening, back stresses, terms of series.
#include "rubato/deck/parts.hpp"
#include "rubato/deck/rows.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::deck {
namespace {

using study::HardeningEntry;
using study::LawKind;
using study::Material;

/// Words that only some laws take.
struct LawWord {
  std::string_view key;
  bool (*takes)(LawKind law);
};
constexpr std::array law_words{
    LawWord{"hardening", [](LawKind law) { return law == LawKind::plastic; }},
    LawWord{"kinematic", [](LawKind law) { return law == LawKind::plastic; }},
    LawWord{"terms", [](LawKind law) { return law == LawKind::prony || law == LawKind::ogden; }},
    LawWord{"volumetric", study::is_hyperelastic}};

std::string takers_of(const LawWord& word) {
  std::vector<std::string_view> names;
  for (const auto& law : study::material_laws)
    if (word.takes(law.law))
      names.push_back(law.name);
  return fmt::format("{} take{} it", fmt::join(names, " and "), names.size() == 1 ? "s" : "");
}

void refuse_words_of_others(MapReader& map, LawKind law) {
  for (const auto& word : law_words)
    if (!word.takes(law))
      refuse_of_others(map, word.key, "the law", study::entry_of(law).name, takers_of(word));
}

/// Points of a table, two numbers each; no rule about them is judged where one cannot be read.
void read_points(const Value& value, std::vector<std::array<double, 2>>& points) {
  for (const auto& item : items(value)) {
    std::array<double, 2> point{};
    if (read_pair(item, point))
      points.push_back(point);
    else
      value.spoil();
  }
}

/// H = E E_T/(E − E_T), of a slope E_T of stress over strain; what it was given by is judged here, as the
/// study has H.
void read_tangent_modulus(MapReader& map, Material& material) {
  const auto tangent = map.find("tangent_modulus");
  if (!tangent)
    return;
  map.refuse("modulus", "'tangent_modulus' is given already, expected one of the two");
  double slope = 0;
  if (!read(tangent, slope, study::bounds::tangent_modulus) || !(material.young > 0))
    return map.spoil("modulus");
  if (slope >= material.young)
    tangent->fault(fmt::format("found {}, expected less than Young's modulus, {}", slope, material.young));
  else
    material.plasticity.modulus = material.young * slope / (material.young - slope);
}

void read_hardening_numbers(const Value& value, const HardeningEntry& row, Material& material) {
  MapReader map(value);
  for (const auto& number : row.numbers) {
    double given = 0;
    if (read(number.required ? map.require(number.key) : map.find(number.key), given))
      number.set(material.plasticity, given);
  }
  if (row.kind == study::HardeningKind::linear)
    read_tangent_modulus(map, material);
  map.finish();
}

void read_hardening(const Value& value, Material& material) {
  MapReader map(value);
  std::vector<std::string_view> found;
  for (const auto& row : study::hardenings)
    if (const auto given = map.find(row.name)) {
      found.push_back(row.name);
      material.plasticity.hardening = row.kind;
      if (study::is_table(row.kind))
        read_points(*given, material.plasticity.points);
      else
        read_hardening_numbers(*given, row, material);
    }
  map.finish();
  const bool unknown_key_told = found.empty() && !value.tree().entries.empty();
  if (map.is_map() && found.size() != 1 && !unknown_key_told)
    value.fault(
        fmt::format("found {}, expected one of linear, table, tension_table, voce, johnson_cook",
                    found.empty() ? "no kind of hardening" : fmt::format("{}", fmt::join(found, " and "))));
  if (found.size() != 1)
    value.spoil();
}

study::BackStress read_back_stress(const Value& value) {
  study::BackStress term;
  MapReader map(value);
  read(map.require("modulus"), term.modulus);
  read(map.find("recall"), term.recall);
  map.finish();
  return term;
}

/// One back stress, or a list of them.
void read_kinematic(const Value& value, std::vector<study::BackStress>& terms) {
  if (value.tree().is(Tree::Kind::map)) {
    terms.push_back(read_back_stress(value));
    return;
  }
  for (const auto& item : items(value))
    terms.push_back(read_back_stress(item));
}

void read_terms(const Value& value, Material& material) {
  for (const auto& item : items(value)) {
    MapReader map(item);
    double shear = 0;
    double other = 0;
    const bool relaxes = material.law == LawKind::prony;
    read(map.require("shear"), shear);
    read(map.require(relaxes ? "time" : "exponent"), other);
    map.refuse(relaxes ? "exponent" : "time",
               relaxes ? "the law prony takes no exponent, expected shear and time"
                       : "the law ogden takes no time, expected shear and exponent");
    map.finish();
    if (relaxes)
      material.prony.push_back({shear, other});
    else
      material.hyperelasticity.terms.push_back({shear, other});
  }
}

void read_own_words(MapReader& map, Material& material) {
  if (material.law == LawKind::plastic) {
    if (const auto hardening = map.require("hardening"))
      read_hardening(*hardening, material);
    if (const auto kinematic = map.find("kinematic"))
      read_kinematic(*kinematic, material.plasticity.kinematic);
  }
  if (material.law == LawKind::prony || material.law == LawKind::ogden)
    if (const auto terms = map.require("terms"))
      read_terms(*terms, material);
  if (study::is_hyperelastic(material.law))
    read(map.find("volumetric"), material.hyperelasticity.volume, study::volume_energy_words);
}

template <class E, std::size_t N>
void read_word(MapReader& map, std::string_view key, std::optional<E>& target,
               const std::array<study::Word<E>, N>& words) {
  E value{};
  const auto given = map.find(key);
  if (!given)
    return;
  if (read(given, value, words))
    target = value;
  else
    given->spoil();
}

void read_cell_words(MapReader& map, Material& material) {
  read_word(map, "strain", material.strain, study::strain_words);
  read_word(map, "formulation", material.formulation, study::formulation_words);
}

} // namespace

void read_law_words(MapReader& map, study::Material& material) {
  refuse_words_of_others(map, material.law);
  read_own_words(map, material);
  read_cell_words(map, material);
}

void pass_law_words(MapReader& map) {
  for (const auto& word : law_words) {
    map.find(word.key);
    map.spoil(word.key);
  }
  for (const auto* key : {"strain", "formulation"}) {
    map.find(key);
    map.spoil(key);
  }
}

} // namespace rubato::deck
