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

inline constexpr std::array<LawEntry, 1> material_laws{{
    {.law = LawKind::elastic,
     .name = "elastic",
     .code_aster = "ELAS",
     .summary = "isotropic linear elasticity",
     .numbers = elastic_numbers,
     .faults = nullptr},
}};

/// Rows stand in the order of the laws.
constexpr const LawEntry& entry_of(LawKind law) {
  return material_laws[static_cast<std::size_t>(law)];
}

} // namespace rubato::study
