// SPDX-License-Identifier: LGPL-3.0-or-later
/// Material laws: a row each, with its word, its numbers and their bounds.
#pragma once

#include "rubato/study/number.hpp"
#include "rubato/study/study.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::study {

/// A rule about several numbers of a law that is broken.
struct LawFault {
  std::vector<std::string_view> keys; ///< the numbers it is about
  bool missing = false;               ///< the first of them is not there: it is told at the material
  std::string text;                   ///< a sentence
};

struct LawEntry {
  LawKind law;
  std::string_view name;
  std::string_view code_aster;
  std::string_view summary;
  std::span<const Number<Material>> numbers;
  bool in_place;                       ///< whether the numbers may depend on the place
  std::span<const StrainKind> strains; ///< that it may see
  /// What the bounds of the numbers do not say; may be null. Its file is in rules/.
  std::vector<LawFault> (*faults)(const Material& material, Physics physics);
};

inline constexpr std::array elastic_numbers{
    number<Material, &Material::young>("young", "Young's modulus [force/length²]", above(0), true),
    number<Material, &Material::poisson>("poisson", "Poisson's ratio", between(-1, 0.5), true)};

template <auto Member>
constexpr Number<Material> orthotropic_number(std::string_view key, std::string_view meaning, Range range,
                                              bool required = false) {
  return number<Material, &Material::orthotropy, Member>(key, meaning, range, required);
}
/// Bounds of ratios follow from the moduli: orthotropic_faults has them.
inline constexpr std::array orthotropic_numbers{
    orthotropic_number<&Orthotropy::young_x>("young_x", "Young's modulus along x' [force/length²]", above(0),
                                             true),
    orthotropic_number<&Orthotropy::young_y>("young_y", "Young's modulus along y' [force/length²]", above(0),
                                             true),
    orthotropic_number<&Orthotropy::young_z>("young_z", "Young's modulus along z' [force/length²]", above(0)),
    orthotropic_number<&Orthotropy::poisson_xy>("poisson_xy", "contraction along y' under a stress along x'",
                                                Range{}, true),
    orthotropic_number<&Orthotropy::poisson_yz>("poisson_yz", "contraction along z' under a stress along y'",
                                                Range{}),
    orthotropic_number<&Orthotropy::poisson_xz>("poisson_xz", "contraction along z' under a stress along x'",
                                                Range{}),
    orthotropic_number<&Orthotropy::shear_xy>("shear_xy", "shear modulus of x' and y' [force/length²]",
                                              above(0), true),
    orthotropic_number<&Orthotropy::shear_yz>("shear_yz", "shear modulus of y' and z' [force/length²]",
                                              above(0)),
    orthotropic_number<&Orthotropy::shear_xz>("shear_xz", "shear modulus of x' and z' [force/length²]",
                                              above(0)),
    orthotropic_number<&Orthotropy::angle_z>(
        "angle_z", "turn of the axes about z, the first turn [degrees]; 0 when not given", Range{}),
    orthotropic_number<&Orthotropy::angle_y>(
        "angle_y", "turn of the axes about the new y, the second turn [degrees]; 0 when not given", Range{}),
    orthotropic_number<&Orthotropy::angle_x>(
        "angle_x", "turn of the axes about the new x, the third turn [degrees]; 0 when not given", Range{})};
std::vector<LawFault> orthotropic_faults(const Material& material, Physics physics);

/// What else these laws have is no plain number: study/solids.hpp.
inline constexpr std::array prony_numbers{
    number<Material, &Material::young>("young", "Young's modulus after a long time [force/length²]", above(0),
                                       true),
    number<Material, &Material::poisson>("poisson", "Poisson's ratio after a long time", between(-1, 0.5),
                                         true)};

template <auto Member>
constexpr Number<Material> hyperelastic_number(std::string_view key, std::string_view meaning, Range range,
                                               bool required = false) {
  return number<Material, &Material::hyperelasticity, Member>(key, meaning, range, required);
}
/// Of all hyperelastic laws.
inline constexpr auto hyperelastic_bulk = hyperelastic_number<&Hyperelasticity::bulk>(
    "bulk", "bulk modulus at small strain [force/length²]; or 'poisson'", above(0));
inline constexpr Number<Material> hyperelastic_poisson{
    .key = "poisson",
    .meaning = "Poisson's ratio at small strain, where 'bulk' is not given",
    .range = between(-1, 0.5),
    .required = false,
    .get = [](const Material& material) -> std::optional<double> {
      return material.hyperelasticity.bulk ? std::nullopt : std::optional(material.poisson);
    },
    .set = [](Material& material, double value) { material.poisson = value; }};
inline constexpr std::array hyperelastic_numbers{
    hyperelastic_number<&Hyperelasticity::c10>("c10", "of I₁ − 3 [force/length²]", Range{}, true),
    hyperelastic_number<&Hyperelasticity::c01>(
        "c01", "of I₂ − 3 [force/length²]; 0, neo-Hookean, when not given", Range{}),
    hyperelastic_bulk, hyperelastic_poisson};
inline constexpr std::array yeoh_numbers{
    hyperelastic_number<&Hyperelasticity::c10>("c10", "of I₁ − 3 [force/length²]", above(0), true),
    hyperelastic_number<&Hyperelasticity::c20>("c20", "of (I₁ − 3)² [force/length²]", Range{}),
    hyperelastic_number<&Hyperelasticity::c30>("c30", "of (I₁ − 3)³ [force/length²]", at_least(0)),
    hyperelastic_bulk, hyperelastic_poisson};
inline constexpr std::array ogden_numbers{hyperelastic_bulk, hyperelastic_poisson};

inline constexpr std::array strains_of_elastic{StrainKind::small, StrainKind::green_lagrange,
                                               StrainKind::logarithmic};
inline constexpr std::array strains_of_orthotropic{StrainKind::small, StrainKind::green_lagrange};
/// Plastic strains must be small with green_lagrange: only then does the strain split into a sum of parts.
inline constexpr std::array strains_of_plastic{StrainKind::small, StrainKind::green_lagrange,
                                               StrainKind::logarithmic};
inline constexpr std::array strains_of_prony{StrainKind::small, StrainKind::logarithmic};
inline constexpr std::array strains_of_hyperelastic{StrainKind::green_lagrange};

inline constexpr std::array<LawEntry, 7> material_laws{{
    {.law = LawKind::elastic,
     .name = "elastic",
     .code_aster = "ELAS",
     .summary = "isotropic linear elasticity",
     .numbers = elastic_numbers,
     .in_place = true,
     .strains = strains_of_elastic,
     .faults = nullptr},
    {.law = LawKind::orthotropic,
     .name = "orthotropic",
     .code_aster = "ELAS_ORTH",
     .summary = "linear elasticity with three axes of symmetry, turned by angles",
     .numbers = orthotropic_numbers,
     .in_place = true,
     .strains = strains_of_orthotropic,
     .faults = orthotropic_faults},
    {.law = LawKind::plastic,
     .name = "plastic",
     .code_aster = "VMIS_ISOT_LINE, VMIS_ISOT_TRAC, VMIS_CINE_LINE, VMIS_ECMI_LINE, VMIS_CIN1_CHAB",
     .summary = "von Mises plasticity with isotropic and kinematic hardening",
     .numbers = elastic_numbers,
     .in_place = false,
     .strains = strains_of_plastic,
     .faults = nullptr},
    {.law = LawKind::prony,
     .name = "prony",
     .code_aster = "",
     .summary = "linear viscoelasticity of the shear by a Prony series",
     .numbers = prony_numbers,
     .in_place = false,
     .strains = strains_of_prony,
     .faults = nullptr},
    {.law = LawKind::hyperelastic,
     .name = "hyperelastic",
     .code_aster = "ELAS_HYPER",
     .summary = "neo-Hookean and Mooney-Rivlin rubber",
     .numbers = hyperelastic_numbers,
     .in_place = false,
     .strains = strains_of_hyperelastic,
     .faults = nullptr},
    {.law = LawKind::yeoh,
     .name = "yeoh",
     .code_aster = "",
     .summary = "Yeoh's rubber, three terms of I1",
     .numbers = yeoh_numbers,
     .in_place = false,
     .strains = strains_of_hyperelastic,
     .faults = nullptr},
    {.law = LawKind::ogden,
     .name = "ogden",
     .code_aster = "",
     .summary = "Ogden's rubber, powers of the principal stretches",
     .numbers = ogden_numbers,
     .in_place = false,
     .strains = strains_of_hyperelastic,
     .faults = nullptr},
}};

/// Whether the law may see that strain.
constexpr bool takes(const LawEntry& law, StrainKind strain) {
  return std::ranges::find(law.strains, strain) != law.strains.end();
}

/// Rows stand in the order of the laws.
constexpr const LawEntry& entry_of(LawKind law) {
  return material_laws[static_cast<std::size_t>(law)];
}

} // namespace rubato::study
