// SPDX-License-Identifier: LGPL-3.0-or-later
/// Exponential pressure–overclosure, with p₀ the pressure at gap 0 and c₀ the clearance (*SURFACE BEHAVIOR,
/// PRESSURE-OVERCLOSURE=EXPONENTIAL).
///
/// abaqus    p(g) = p₀/(e − 1) x (eˣ − 1) with x = 1 − g/c₀ for g < c₀, else 0: value and slope are
/// continuous
///           at c₀ (Abaqus Analysis User's Guide, "Contact pressure-overclosure relationships")
/// calculix  p(g) = p₀ exp(−β g) with β = ln(100)/c₀ for g ≤ c₀ (CalculiX CrunchiX User's Manual, "Surface
///           behavior"). CalculiX drops the p₀/100 that is left at c₀. Here the tangent at c₀ leads to 0 at
///           c₀ + 1/β, as a pressure that jumps has no solution at some gaps.
#pragma once

#include "rubato/study/study.hpp"

namespace rubato::contact::exponential {

struct Numbers {
  double pressure = 0;  ///< p₀ > 0 at gap 0 [pressure]
  double clearance = 0; ///< c₀ > 0 [length]
  study::ExponentialCurve curve = study::ExponentialCurve::abaqus;
};

Numbers numbers_of(const study::ContactZone& zone);

/// The gap below which there is a pressure: c₀, or c₀ + 1/β.
double reach(const Numbers& numbers);

/// p(g).
double pressure(double gap, const Numbers& numbers);

/// −dp/dg ≥ 0 [pressure/length].
double stiffness(double gap, const Numbers& numbers);

/// The gap that belongs to a pressure > 0.
double gap_of(double pressure, const Numbers& numbers);

/// W/p with W the energy an area, ∫ p dg from g to the reach; 0 from there on [length]. It does not depend on
/// p₀.
double energy_length(double gap, const Numbers& numbers);

} // namespace rubato::contact::exponential
