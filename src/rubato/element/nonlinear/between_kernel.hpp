// SPDX-License-Identifier: LGPL-3.0-or-later
/// The forces of energy_momentum.hpp in finite strain. With 𝐂 and the mean terms of strain_energy.hpp at {C},
/// B of dE = B(F) du and h = ½[C], of which
///
///   S* = S_½ + g h     f = Σ w B({F})ᵀ S*     g = ([U] − Σ w S_½:h)/Σ w h:h
///
/// the derivative by u at the end is, G being the terms of S* alone (δ_ik S*_JL),
///
///   ½ Σ w (B({F})ᵀ (𝐂 + 2 g I_sym) B(F₁) + G) + ½ mean terms of ({F}, F₁) + Σ w B({F})ᵀ h ⊗ dg
///   dg = Σ w (S₁ − S_½ − ½ 𝐂:h − ½ mean terms of h − 2 g h):B(F₁)du / Σ w h:h
///
/// The symmetric matrix near it has {F} instead of F₁ and no g: half a stiffness in the middle of the step.
#pragma once

#include "rubato/element/energy_momentum.hpp"

namespace rubato::element {

/// evaluate_between() of a kind that is offered, in finite strain.
BetweenResult evaluate_between_large(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                                     const BetweenOutput& output);

} // namespace rubato::element
