// SPDX-License-Identifier: LGPL-3.0-or-later
/// What springs and augmentations a zone's methods have. Springs are part of the model: they give way, hold
/// energy, and their stiffness shows in the answer. Augmentations only lead to it.
#pragma once

#include "rubato/contact/enforcement.hpp"

#include <span>
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

/// The normal spring of a point as a line: g = rest_gap − compliance · force.
struct Penetration {
  double rest_gap = 0;   ///< [length]
  double compliance = 0; ///< [length/force]
};

/// Of a point near a pressing force or, while that is 0, near its gap: of a law that is no line, its tangent.
/// Where gaps close the compliance is `exact`. `weight`: what tractions of the point are multiplied with.
Penetration penetration(const ZoneLaw& law, std::size_t point, double weight, double force, double gap,
                        double exact = 0);

/// The stiffest spring of each point, normal or of friction, whose stiffness does not depend on the
/// friction's limit; 0 where it has none. [force/length]
std::vector<double> spring_stiffness(const ZoneLaw& law, std::span<const PointEvaluation> points);

/// The gap below which points of a zone press [length].
double reach(const Zone& zone);

/// The way over which half the force of a point does the work that its normal spring holds [length].
double spring_depth(const Zone& zone, const PointOutcome& outcome);

/// What the normal springs of a zone hold [force · length].
double stored_energy(const Zone& zone, const ZoneState& state);

/// Multiplies augmentations; springs stay.
void scale_augmentations(const Zone& zone, double normal, double tangential, ZoneCoefficients& coefficients);

/// Takes augmentations that the deck does not give to at most `most` over the point's weight [force/length].
void limit_augmentations(const Zone& zone, double most, ZoneCoefficients& coefficients);

/// Gives springs, and what belongs to them, the coefficients that they have in a step of the `usual` length.
void keep_springs(const Zone& zone, const ZoneCoefficients& usual, ZoneCoefficients& coefficients);

} // namespace rubato::contact
