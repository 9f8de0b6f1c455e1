// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/echo_json.hpp"
#include "rubato/study/formulation.hpp"

#include <nlohmann/json.hpp>

namespace rubato::study {
namespace {

Json echo_hardening(const Plasticity& plasticity) {
  const auto& row = entry_of(plasticity.hardening);
  auto inside = Json::object();
  put_numbers(inside, row, plasticity);
  return {{std::string(row.name), is_table(row.kind) ? Json(plasticity.points) : inside}};
}

Json echo(const BackStress& term) {
  return {{"modulus", term.modulus}, {"recall", term.recall}};
}

Json echo(const PronyTerm& term) {
  return {{"shear", term.shear}, {"time", term.time}};
}

Json echo(const OgdenTerm& term) {
  return {{"shear", term.shear}, {"exponent", term.exponent}};
}

template <class Term> Json echo_terms(const std::vector<Term>& terms) {
  auto list = Json::array();
  for (const auto& term : terms)
    list.push_back(echo(term));
  return list;
}

} // namespace

void put_law_words(Json& map, const Material& material) {
  if (material.law == LawKind::plastic) {
    map["hardening"] = echo_hardening(material.plasticity);
    if (const auto& terms = material.plasticity.kinematic; !terms.empty())
      map["kinematic"] = terms.size() == 1 ? echo(terms.front()) : echo_terms(terms);
  }
  if (material.law == LawKind::prony)
    map["terms"] = echo_terms(material.prony);
  if (material.law == LawKind::ogden)
    map["terms"] = echo_terms(material.hyperelasticity.terms);
  if (is_hyperelastic(material.law))
    map["volumetric"] = word(volume_energy_words, material.hyperelasticity.volume);
  if (material.strain)
    map["strain"] = word(strain_words, *material.strain);
  if (material.formulation)
    map["formulation"] = word(formulation_words, *material.formulation);
}

} // namespace rubato::study
