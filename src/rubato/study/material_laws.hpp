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
