// SPDX-License-Identifier: LGPL-3.0-or-later
/// What springs and augmentations a zone's methods have. Springs are part of the model: they give way, hold
/// energy, and their stiffness shows in the answer. Augmentations only lead to it.
#pragma once

#include "rubato/contact/enforcement.hpp"

#include <string_view>
#include <vector>

namespace rubato::contact {

/// Whether gaps close exactly, so that no normal spring stands in the answer.
bool closes_gaps(const Zone& zone);
/// Whether coefficients of the zone only lead to the answer.
bool has_augmentation(const Zone& zone);

/// A spring whose coefficient the study gives: its key there, and its value.
struct GivenSpring {
  std::string_view key;
  double value;
};
std::vector<GivenSpring> given_springs(const Zone& zone);

/// How far a unit of force pushes the point in, by its normal spring, where its tractions are multiplied with
/// `weight`; `exact` where gaps close. [length/force]
double penetration_compliance(const Zone& zone, const ZoneCoefficients& coefficients, std::size_t point,
                              double weight, double exact = 0);

/// The stiffest spring of a point whose stiffness does not depend on the pressure, normal or of friction; 0
/// where it has none. [force/length]
double spring_stiffness(const Zone& zone, const ZoneCoefficients& coefficients, std::size_t point);

/// The gap at which a point presses no more: that of a spring is 0, any other one's is what it is at.
double rest_gap(const Zone& zone, const PointOutcome& outcome);

/// What the normal springs of a zone hold, ½ N ⟨−g⟩ each [force · length].
double stored_energy(const Zone& zone, const ZoneState& state);

/// Multiplies augmentations; springs stay.
void scale_augmentations(const Zone& zone, double normal, double tangential, ZoneCoefficients& coefficients);

/// Takes augmentations that the deck does not give to at most `most` over the point's weight [force/length].
void limit_augmentations(const Zone& zone, double most, ZoneCoefficients& coefficients);

/// Gives springs, and what belongs to them, the coefficients that they have in a step of the `usual` length.
void keep_springs(const Zone& zone, const ZoneCoefficients& usual, ZoneCoefficients& coefficients);

} // namespace rubato::contact
