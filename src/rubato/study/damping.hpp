// SPDX-License-Identifier: LGPL-3.0-or-later
/// Rayleigh's coefficients of a material.
#pragma once

#include "rubato/study/study.hpp"

namespace rubato::study {

/// C = stiffness · K + mass · M.
struct RayleighCoefficients {
  double stiffness = 0; ///< [time]
  double mass = 0;      ///< [1/time]
};

/// A mode of circular frequency ω has the damping ratio ξ = mass/(2ω) + stiffness ω/2 (A. K. Chopra, Dynamics
/// of Structures, ch. 11). Of a material with ratios at two frequencies f, ω = 2πf, those that have them:
///   stiffness = 2 (ξ₂ω₂ − ξ₁ω₁)/(ω₂² − ω₁²),  mass = 2 ω₁ω₂ (ξ₁ω₂ − ξ₂ω₁)/(ω₂² − ω₁²)
/// either may be negative or, of equal frequencies, no number: the rules refuse that.
RayleighCoefficients rayleigh_coefficients(const Material& material);

/// Bounds of the ratio at the higher frequency, with which both coefficients are ≥ 0: ξ f_low/f_high and
/// ξ f_high/f_low, ξ the ratio at the lower one.
double least_ratio_at_higher_frequency(const DampingRatios& damping);
double largest_ratio_at_higher_frequency(const DampingRatios& damping);

} // namespace rubato::study
