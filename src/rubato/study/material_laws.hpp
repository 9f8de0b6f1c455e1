// SPDX-License-Identifier: LGPL-3.0-or-later
/// Material laws: a row each, with its word, its numbers and their bounds.
#pragma once

#include "rubato/study/number.hpp"
#include "rubato/study/study.hpp"

#include <array>
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
  /// What the bounds of the numbers do not say; may be null. Its file is in rules/.
  std::vector<LawFault> (*faults)(const Material& material, Physics physics);
};

inline constexpr std::array elastic_numbers{
    number<Material, &Material::young>("young", above(0), true),
    number<Material, &Material::poisson>("poisson", between(-1, 0.5), true)};

template <auto Member>
constexpr Number<Material> orthotropic_number(std::string_view key, Range range, bool required = false) {
  return number<Material, &Material::orthotropy, Member>(key, range, required);
}
/// Bounds of ratios follow from the moduli: orthotropic_faults has them.
inline constexpr std::array orthotropic_numbers{
    orthotropic_number<&Orthotropy::young_x>("young_x", above(0), true),
    orthotropic_number<&Orthotropy::young_y>("young_y", above(0), true),
    orthotropic_number<&Orthotropy::young_z>("young_z", above(0)),
    orthotropic_number<&Orthotropy::poisson_xy>("poisson_xy", Range{}, true),
    orthotropic_number<&Orthotropy::poisson_yz>("poisson_yz", Range{}),
    orthotropic_number<&Orthotropy::poisson_xz>("poisson_xz", Range{}),
    orthotropic_number<&Orthotropy::shear_xy>("shear_xy", above(0), true),
    orthotropic_number<&Orthotropy::shear_yz>("shear_yz", above(0)),
    orthotropic_number<&Orthotropy::shear_xz>("shear_xz", above(0)),
    orthotropic_number<&Orthotropy::angle_z>("angle_z", Range{}),
    orthotropic_number<&Orthotropy::angle_y>("angle_y", Range{}),
    orthotropic_number<&Orthotropy::angle_x>("angle_x", Range{})};
std::vector<LawFault> orthotropic_faults(const Material& material, Physics physics);

inline constexpr std::array<LawEntry, 2> material_laws{{
    {.law = LawKind::elastic,
     .name = "elastic",
     .code_aster = "ELAS",
     .summary = "isotropic linear elasticity",
     .numbers = elastic_numbers,
     .faults = nullptr},
    {.law = LawKind::orthotropic,
     .name = "orthotropic",
     .code_aster = "ELAS_ORTH",
     .summary = "linear elasticity with three axes of symmetry, turned by angles",
     .numbers = orthotropic_numbers,
     .faults = orthotropic_faults},
}};

/// Rows stand in the order of the laws.
constexpr const LawEntry& entry_of(LawKind law) {
  return material_laws[static_cast<std::size_t>(law)];
}

} // namespace rubato::study
