// SPDX-License-Identifier: LGPL-3.0-or-later
/// Exponential pressure–overclosure (Abaqus Analysis User's Guide, "Contact pressure-overclosure
/// relationships", *SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL). With p₀ the pressure at gap 0, c₀
/// the gap at which it begins, and x = 1 − g/c₀:
///   p(g) = p₀/(e − 1) x (eˣ − 1)   for g < c₀, else 0.
/// Value and slope are continuous at c₀.
#pragma once

namespace rubato::contact::exponential {

struct Numbers {
  double pressure = 0;  ///< p₀ > 0 at gap 0 [pressure]
  double clearance = 0; ///< c₀ > 0 [length]
};

/// p(g).
double pressure(double gap, const Numbers& numbers);

/// −dp/dg ≥ 0 [pressure/length].
double stiffness(double gap, const Numbers& numbers);

/// The gap below c₀ that belongs to a pressure > 0.
double gap_of(double pressure, const Numbers& numbers);

/// W/p with W the energy an area, ∫ p dg from g to c₀; 0 from c₀ on [length].
double energy_length(double gap, double clearance);

} // namespace rubato::contact::exponential
