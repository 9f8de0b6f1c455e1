// SPDX-License-Identifier: LGPL-3.0-or-later
/// Materials beyond linear elasticity, one of each kind that the balance of energy tells apart.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/study/study.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace rubato::test {

/// What makes an elastic material of the same Young's modulus one of this law.
struct NamedLaw {
  std::string name;
  void (*give)(study::Material& material);
};

/// Yields at a strain of 0.4 %.
inline void make_plastic(study::Material& material) {
  const double young = material.young;
  material.law = study::LawKind::plastic;
  material.plasticity.yield_stress = 0.004 * young;
  material.plasticity.modulus = 0.02 * young;
  material.plasticity.kinematic = {{0.05 * young, 0}, {0.1 * young, 20}};
}

inline void make_rubber(study::Material& material) {
  const double young = material.young;
  material.law = study::LawKind::hyperelastic;
  material.hyperelasticity.c10 = young / 10;
  material.hyperelasticity.c01 = young / 20;
  material.hyperelasticity.bulk = 2 * young;
  material.young = material.poisson = 0;
}

/// Times of the order of one: of decks whose steps are.
inline void make_viscous(study::Material& material) {
  material.law = study::LawKind::prony;
  material.prony = {{material.young / 4, 0.3}, {material.young / 8, 3}};
}

inline const std::vector<NamedLaw> every_law{
    {"Plastic", make_plastic},
    {"PlasticEnhanced",
     [](study::Material& material) {
       make_plastic(material);
       material.formulation = study::Formulation::enhanced;
     }},
    {"PlasticLogarithmic",
     [](study::Material& material) {
       make_plastic(material);
       material.strain = study::StrainKind::logarithmic;
     }},
    {"Prony", make_viscous},
    {"PronyLogarithmic",
     [](study::Material& material) {
       make_viscous(material);
       material.strain = study::StrainKind::logarithmic;
     }},
    {"GreenLagrange", [](study::Material& material) { material.strain = study::StrainKind::green_lagrange; }},
    {"GreenLagrangeEnhanced",
     [](study::Material& material) {
       material.strain = study::StrainKind::green_lagrange;
       material.formulation = study::Formulation::enhanced;
     }},
    {"GreenLagrangeMeanDilatation",
     [](study::Material& material) {
       material.strain = study::StrainKind::green_lagrange;
       material.formulation = study::Formulation::mean_dilatation;
     }},
    {"Logarithmic", [](study::Material& material) { material.strain = study::StrainKind::logarithmic; }},
    {"Rubber", make_rubber},
    {"RubberFull",
     [](study::Material& material) {
       make_rubber(material);
       material.formulation = study::Formulation::full;
     }},
    {"Reduced", [](study::Material& material) { material.formulation = study::Formulation::reduced; }},
    {"GreenLagrangeReduced",
     [](study::Material& material) {
       material.strain = study::StrainKind::green_lagrange;
       material.formulation = study::Formulation::reduced;
     }},
    {"RubberReduced",
     [](study::Material& material) {
       make_rubber(material);
       material.formulation = study::Formulation::reduced;
     }},
    {"PronyLogarithmicReduced",
     [](study::Material& material) {
       make_viscous(material);
       material.strain = study::StrainKind::logarithmic;
       material.formulation = study::Formulation::reduced;
     }},
};

/// Those of explicit runs alone.
inline const std::vector<NamedLaw> every_explicit_law{
    {"PlasticReduced",
     [](study::Material& material) {
       make_plastic(material);
       material.formulation = study::Formulation::reduced;
     }},
    {"PlasticLogarithmicReduced",
     [](study::Material& material) {
       make_plastic(material);
       material.strain = study::StrainKind::logarithmic;
       material.formulation = study::Formulation::reduced;
     }},
};

/// Whether its bodies give back all that is done to them and have forces of whole steps: the scheme
/// energy_momentum takes them.
inline bool is_elastic(const NamedLaw& law) {
  study::Material material;
  material.young = 1;
  law.give(material);
  return material.law != study::LawKind::plastic && material.law != study::LawKind::prony &&
         material.formulation != study::Formulation::reduced;
}

/// The study of a deck whose material of that place has the law.
inline study::Study study_with(std::string_view deck, const NamedLaw& law,
                               const std::vector<deck::Setting>& changes = {}, std::size_t material = 0) {
  auto study = deck::parse_deck(deck, "deck.yaml", changes).runs.front();
  law.give(study.materials.at(material));
  return study;
}

} // namespace rubato::test
