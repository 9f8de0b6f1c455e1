// SPDX-License-Identifier: LGPL-3.0-or-later
/// Material laws of one point, with memory and for finite strain: stress, tangent and stored energy from a
/// strain, the state at the start of the step and its length; nothing about meshes.
///
/// The strain is ε (small), Green–Lagrange's E or ½ ln C (logarithmic). Hyperelastic laws take
/// Green–Lagrange's E and give S. A state is zero at first. A new law is a file with a type and the functions
/// below (those of point_response.hpp come by themselves for laws without memory), `is_hyperelastic`, and its
/// row in `SpaceLaw`.
#pragma once

#include "rubato/material/elastic_point.hpp"
#include "rubato/material/mooney_rivlin.hpp"
#include "rubato/material/ogden.hpp"
#include "rubato/material/plane_stress.hpp"
#include "rubato/material/plastic.hpp"
#include "rubato/material/point_response.hpp"
#include "rubato/material/prony.hpp"
#include "rubato/material/space_law.hpp"
#include "rubato/material/yeoh.hpp"

#include <variant>

namespace rubato::material {

using PointLaw = std::variant<ElasticPoint, Plastic, Prony, MooneyRivlin, Yeoh, Ogden, PlaneStress>;

/// How many numbers the law remembers of a point's past.
int state_size(const PointLaw& law);

/// `old`: state at the start of the step, `now`: written, both state_size long, and not the same memory. No
/// memory is allocated. Returns false where the local iteration has no end or the strain is none (C not
/// positive definite): the attempt of the step fails, and `now` and `out` have no meaning. A strain that is
/// not finite gives false or a stress that is not finite.
bool respond(const PointLaw& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out);

/// What a step that led from `old` to `now` dissipated and stored elsewhere; `mean_stress`: half the sum of
/// the stresses at both ends.
Dissipation dissipation(const PointLaw& law, std::span<const double> old, std::span<const double> now,
                        const Stress6& mean_stress);

/// ε^p, engineering shears; 0 where the law has none.
Strain6 plastic_strain(const PointLaw& law, std::span<const double> state);

/// p = ∫ √(2/3 dε^p:dε^p); 0 where the law has none.
double cumulated_plastic_strain(const PointLaw& law, std::span<const double> state);

/// Whether the tangent is symmetric at every state.
bool tangent_is_symmetric(const PointLaw& law);

/// Whether free expansion divides F: the law stores W(F/(1 + α ΔT)) by undeformed volume. From the strains of
/// other laws it is subtracted.
bool is_hyperelastic(const PointLaw& law);

/// Whether the response depends on StepInfo::length.
bool depends_on_rate(const PointLaw& law);

} // namespace rubato::material
