// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/make_point_law.hpp"

#include "rubato/study/formulation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace rubato::material {
namespace {

using study::HardeningKind;
using study::LawKind;
using study::Material;

std::vector<TableHardening::Point> points_of(const study::Plasticity& plasticity) {
  std::vector<TableHardening::Point> points;
  for (const auto& [strain, stress] : plasticity.points)
    points.push_back({strain, stress});
  return points;
}

Hardening hardening_of(const Material& material) {
  const auto& given = material.plasticity;
  switch (given.hardening) {
  case HardeningKind::linear:
    return LinearHardening{given.yield_stress, given.modulus};
  case HardeningKind::table:
    return TableHardening{points_of(given)};
  case HardeningKind::tension_table:
    return hardening_of_tension(material.young, points_of(given));
  case HardeningKind::voce:
    return VoceHardening{given.yield_stress, given.saturation, given.rate, given.modulus};
  case HardeningKind::johnson_cook:
    return JohnsonCook{given.yield_stress, given.factor, given.exponent, given.rate_factor,
                       given.reference_rate};
  }
  throw std::logic_error("a kind of hardening without its row");
}

Plastic plastic_of(const Material& material) {
  Plastic law{material.young, material.poisson, hardening_of(material), {}};
  for (const auto& [modulus, recall] : material.plasticity.kinematic)
    law.kinematic.terms.at(static_cast<std::size_t>(law.kinematic.count++)) = {modulus, recall};
  return law;
}

Prony prony_of(const Material& material) {
  Prony law{material.young, material.poisson, {}};
  for (const auto& [shear, time] : material.prony)
    law.terms.push_back({shear, time});
  return law;
}

double shear_modulus(const Material& material) {
  const auto& given = material.hyperelasticity;
  if (material.law != LawKind::ogden)
    return 2 * (given.c10 + given.c01);
  double sum = 0;
  for (const auto& term : given.terms)
    sum += term.shear;
  return sum;
}

double bulk_of(const Material& material) {
  const auto& bulk = material.hyperelasticity.bulk;
  return bulk ? *bulk : bulk_modulus(shear_modulus(material), material.poisson);
}

Ogden ogden_of(const Material& material, Volumetric volumetric) {
  Ogden law{{}, bulk_of(material), volumetric};
  for (const auto& [shear, exponent] : material.hyperelasticity.terms)
    law.terms.push_back({shear, exponent});
  return law;
}

SpaceLaw space_law(const Material& material) {
  const auto& hyper = material.hyperelasticity;
  const auto volumetric =
      hyper.volume == study::VolumeEnergy::logarithmic ? Volumetric::logarithmic : Volumetric::quadratic;
  switch (material.law) {
  case LawKind::elastic:
    return make_elastic_point(material.young, material.poisson);
  case LawKind::orthotropic:
    return make_elastic_point(make_orthotropic(material.orthotropy, 0));
  case LawKind::plastic:
    return plastic_of(material);
  case LawKind::prony:
    return prony_of(material);
  case LawKind::hyperelastic:
    return MooneyRivlin{hyper.c10, hyper.c01, bulk_of(material), volumetric};
  case LawKind::yeoh:
    return Yeoh{hyper.c10, hyper.c20, hyper.c30, bulk_of(material), volumetric};
  case LawKind::ogden:
    return ogden_of(material, volumetric);
  }
  throw std::logic_error("a material law without its row in make_point_law");
}

SmallStrainModuli of_shear_and_bulk(double shear, double bulk) {
  return {9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (2 * (3 * bulk + shear))};
}

} // namespace

SmallStrainModuli small_strain_moduli(const Material& material) {
  if (study::is_hyperelastic(material.law))
    return of_shear_and_bulk(shear_modulus(material), bulk_of(material));
  if (material.law != LawKind::prony)
    return {material.young, material.poisson};
  double shear = material.young / (2 * (1 + material.poisson));
  for (const auto& term : material.prony)
    shear += term.shear;
  return of_shear_and_bulk(shear, material.young / (3 * (1 - 2 * material.poisson)));
}

PointLaw make_point_law(const Material& material, study::Physics physics) {
  auto law = space_law(material);
  if (physics == study::Physics::plane_stress)
    return PlaneStress{std::move(law)};
  return std::visit([](auto& one) -> PointLaw { return std::move(one); }, law);
}

} // namespace rubato::material
