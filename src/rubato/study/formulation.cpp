// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/formulation.hpp"

#include <algorithm>

namespace rubato::study {

bool is_hyperelastic(LawKind law) {
  return law == LawKind::hyperelastic || law == LawKind::yeoh || law == LawKind::ogden;
}

StrainKind strain_of(const Material& material) {
  const auto usual = is_hyperelastic(material.law) ? StrainKind::green_lagrange : StrainKind::small;
  return material.strain.value_or(usual);
}

bool has_constant_stiffness(const Material& material) {
  return (material.law == LawKind::elastic || material.law == LawKind::orthotropic) &&
         strain_of(material) == StrainKind::small;
}

bool averages_dilatation(CellType type, Physics physics) {
  switch (type) {
  case CellType::tria3:
  case CellType::tetra4:
  case CellType::pyra5:
  case CellType::pyra13:
    return false;
  default:
    return physics != Physics::plane_stress;
  }
}

bool has_one_point(CellType type) {
  return type == CellType::quad4 || type == CellType::hexa8;
}

namespace {

bool has_cells(Formulation formulation, CellType type, Physics physics) {
  switch (formulation) {
  case Formulation::mean_dilatation:
    return averages_dilatation(type, physics);
  case Formulation::enhanced:
    return type == CellType::quad4 || type == CellType::hexa8;
  case Formulation::reduced:
    return has_one_point(type) || type == CellType::quad8 || type == CellType::hexa20 ||
           type == CellType::penta6 || type == CellType::penta15;
  case Formulation::full:
    break;
  }
  return true;
}

} // namespace

Formulation wanted_formulation(const Material& material) {
  const bool flows = material.law == LawKind::plastic || is_hyperelastic(material.law);
  return material.formulation.value_or(flows ? Formulation::mean_dilatation : Formulation::full);
}

Formulation formulation_of(const Material& material, Physics physics, CellType type) {
  const auto wanted = wanted_formulation(material);
  return has_cells(wanted, type, physics) ? wanted : Formulation::full;
}

bool is_heated(const Study& study, const Material& material) {
  return material.expansion && !study.temperatures.empty();
}

bool is_linear(const Study& study, const Material& material) {
  const auto wanted = wanted_formulation(material);
  return has_constant_stiffness(material) && wanted != Formulation::reduced &&
         (wanted == Formulation::full || !is_heated(study, material));
}

bool is_linear(const Study& study) {
  return std::ranges::all_of(study.materials,
                             [&](const Material& material) { return is_linear(study, material); }) &&
         std::ranges::none_of(study.connectors, &Connector::rotates);
}

bool remembers(const Material& material) {
  return material.law == LawKind::plastic || material.law == LawKind::prony ||
         wanted_formulation(material) == Formulation::enhanced;
}

bool remembers(const Study& study) {
  return std::ranges::any_of(study.materials, [](const Material& material) { return remembers(material); });
}

bool yields(const Study& study) {
  return std::ranges::any_of(study.materials,
                             [](const Material& material) { return material.law == LawKind::plastic; });
}

bool takes_large_rotations(const Study& study) {
  return std::ranges::any_of(
      study.materials, [](const Material& material) { return strain_of(material) != StrainKind::small; });
}

} // namespace rubato::study
