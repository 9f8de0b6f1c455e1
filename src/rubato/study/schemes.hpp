// SPDX-License-Identifier: LGPL-3.0-or-later
/// Time schemes: a row each, with its word, its numbers and their bounds.
#pragma once

#include "rubato/study/number.hpp"
#include "rubato/study/study.hpp"

#include <array>
#include <span>
#include <string_view>

namespace rubato::study {

using SchemeNumber = Number<TimeStepping>;

struct SchemeEntry {
  SchemeKind kind;
  std::string_view name;
  std::string_view code_aster;
  std::string_view summary;
  std::span<const SchemeNumber> numbers;
};

/// γ below 1/2 feeds energy in.
inline constexpr std::array newmark_numbers{
    number<TimeStepping, &TimeStepping::beta>("beta", "Newmark's β, 1/4 when not given", between(0, 1)),
    number<TimeStepping, &TimeStepping::gamma>("gamma", "Newmark's γ, 1/2 when not given", from_to(0.5, 2))};
inline constexpr std::array hht_numbers{number<TimeStepping, &TimeStepping::alpha>(
    "alpha", "weight of the forces at the start of the step, negative", from_to(-1.0 / 3.0, 0), true)};
inline constexpr std::array modified_average_acceleration_numbers{
    number<TimeStepping, &TimeStepping::alpha>("alpha", "numerical damping, negative", at_most(0), true)};
inline constexpr std::array generalized_alpha_numbers{number<TimeStepping, &TimeStepping::spectral_radius>(
    "spectral_radius", "ρ_∞, the spectral radius at high frequency; 0.5 when not given", from_to(0, 1))};
inline constexpr std::array wbz_alpha_numbers{number<TimeStepping, &TimeStepping::alpha>(
    "alpha", "weight of the inertia at the start of the step, negative", from_to(-1, 0), true)};
inline constexpr std::array moreau_jean_numbers{number<TimeStepping, &TimeStepping::theta>(
    "theta", "weight of the end of the step; 1/2 when not given", from_to(0.5, 1))};
/// `record` has a default that follows from the length of the run, and so is no number of the row.
inline constexpr std::array central_difference_numbers{number<TimeStepping, &TimeStepping::safety>(
    "safety", "with step: auto, the part of the stable step that is taken; 0.9 when not given",
    Range{.low = 0, .high = 1, .low_allowed = false})};

inline constexpr std::array<SchemeEntry, 9> schemes{{
    {.kind = SchemeKind::newmark,
     .name = "newmark",
     .code_aster = "NEWMARK",
     .summary = "average acceleration, or any β and γ",
     .numbers = newmark_numbers},
    {.kind = SchemeKind::hht,
     .name = "hht",
     .code_aster = "HHT, MODI_EQUI='OUI'",
     .summary = "α in −1/3…0 damps high frequencies",
     .numbers = hht_numbers},
    {.kind = SchemeKind::modified_average_acceleration,
     .name = "modified_average_acceleration",
     .code_aster = "HHT, MODI_EQUI='NON'",
     .summary = "hht's β and γ with equilibrium at the end of the step",
     .numbers = modified_average_acceleration_numbers},
    {.kind = SchemeKind::generalized_alpha,
     .name = "generalized_alpha",
     .code_aster = "",
     .summary = "Chung and Hulbert, from the spectral radius ρ_∞",
     .numbers = generalized_alpha_numbers},
    {.kind = SchemeKind::wbz_alpha,
     .name = "wbz_alpha",
     .code_aster = "",
     .summary = "Wood, Bossak and Zienkiewicz: α in −1…0 weighs the inertia and damps high frequencies",
     .numbers = wbz_alpha_numbers},
    {.kind = SchemeKind::moreau_jean,
     .name = "moreau_jean",
     .code_aster = "",
     .summary = "θ-method on velocities, which jump where bodies hit: keeps energy with exact contact",
     .numbers = moreau_jean_numbers},
    {.kind = SchemeKind::energy_momentum,
     .name = "energy_momentum",
     .code_aster = "",
     .summary = "moreau_jean with θ = 1/2 and internal forces by which elastic bodies in finite strain keep "
                "energy and momenta",
     .numbers = {}},
    {.kind = SchemeKind::static_steps,
     .name = "static",
     .code_aster = "STAT_NON_LINE",
     .summary = "load steps in pseudo-time, no inertia",
     .numbers = {}},
    {.kind = SchemeKind::central_difference,
     .name = "central_difference",
     .code_aster = "DIFF_CENT",
     .summary = "explicit: lumped mass, short stable steps that cost a product each",
     .numbers = central_difference_numbers},
}};

/// Rows stand in the order of the schemes.
constexpr const SchemeEntry& entry_of(SchemeKind kind) {
  return schemes[static_cast<std::size_t>(kind)];
}

} // namespace rubato::study
