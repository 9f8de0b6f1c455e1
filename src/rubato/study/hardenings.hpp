// SPDX-License-Identifier: LGPL-3.0-or-later
/// How the yield stress R grows with the cumulated plastic strain p: a row each, with its word, its numbers
/// and their bounds.
#pragma once

#include "rubato/study/number.hpp"
#include "rubato/study/solids.hpp"

#include <array>
#include <span>
#include <string_view>

namespace rubato::study {

struct HardeningEntry {
  HardeningKind kind;
  std::string_view name;
  std::string_view code_aster;
  std::string_view summary;
  std::span<const Number<Plasticity>> numbers; ///< none of tables, which are lists of points
};

inline constexpr auto yield_stress_number = number<Plasticity, &Plasticity::yield_stress>(
    "yield_stress", "yield stress without plastic strain [force/length²]", above(0), true);
inline constexpr auto hardening_modulus_number = number<Plasticity, &Plasticity::modulus>(
    "modulus", "slope of the yield stress over plastic strain [force/length²]; 0 when not given",
    at_least(0));
inline constexpr std::array linear_hardening_numbers{yield_stress_number, hardening_modulus_number};
inline constexpr std::array voce_hardening_numbers{
    yield_stress_number,
    number<Plasticity, &Plasticity::saturation>(
        "saturation", "what the yield stress gains in the end, besides the modulus [force/length²]",
        at_least(0), true),
    number<Plasticity, &Plasticity::rate>("exponent", "b of 1 − exp(−b p)", at_least(0), true),
    hardening_modulus_number};
inline constexpr std::array johnson_cook_numbers{
    yield_stress_number,
    number<Plasticity, &Plasticity::factor>("factor", "B of B pⁿ [force/length²]", at_least(0), true),
    number<Plasticity, &Plasticity::exponent>("exponent", "n of B pⁿ", above(0), true),
    number<Plasticity, &Plasticity::rate_factor>(
        "rate_factor", "C of 1 + C ln(rate of plastic strain/reference_rate); 0 when not given", at_least(0)),
    number<Plasticity, &Plasticity::reference_rate>(
        "reference_rate", "rate of plastic strain below which C has no effect [1/time]; 1 when not given",
        above(0))};

inline constexpr std::array<HardeningEntry, 5> hardenings{{
    {.kind = HardeningKind::linear,
     .name = "linear",
     .code_aster = "ECRO_LINE",
     .summary = "R = yield_stress + modulus p",
     .numbers = linear_hardening_numbers},
    {.kind = HardeningKind::table,
     .name = "table",
     .code_aster = "",
     .summary = "points of plastic strain and yield stress, linear in between and beyond the last",
     .numbers = {}},
    {.kind = HardeningKind::tension_table,
     .name = "tension_table",
     .code_aster = "TRACTION",
     .summary = "points of strain and stress of a tension test",
     .numbers = {}},
    {.kind = HardeningKind::voce,
     .name = "voce",
     .code_aster = "CIN1_CHAB: R_0, R_I, B",
     .summary = "R = yield_stress + saturation (1 − exp(−exponent p)) + modulus p",
     .numbers = voce_hardening_numbers},
    {.kind = HardeningKind::johnson_cook,
     .name = "johnson_cook",
     .code_aster = "ECRO_COOK",
     .summary = "Johnson and Cook: powers of plastic strain, logarithm of its rate",
     .numbers = johnson_cook_numbers},
}};

/// Rows stand in the order of the kinds.
constexpr const HardeningEntry& entry_of(HardeningKind kind) {
  return hardenings[static_cast<std::size_t>(kind)];
}

constexpr bool is_table(HardeningKind kind) {
  return kind == HardeningKind::table || kind == HardeningKind::tension_table;
}

} // namespace rubato::study
