// SPDX-License-Identifier: LGPL-3.0-or-later
/// Forces of HEXA8 with small strain and without a tangent: what explicit runs ask for in every step. They
/// are those of CellKernel to rounding.
///
/// A trilinear function has at the 2×2×2 points four values of each derivative ∂/∂ξ_k, which does not change
/// along ξ_k. Places and displacements are derived by ξ only, and forces gathered the same way back: with
/// J = ∂X/∂ξ and w = det J, the weights of the rule being 1,
///
///   ∂u/∂X = (∂u/∂ξ) J⁻¹,   f_i = Σ_k Σ (w σ J⁻ᵀ)_k ∂N_i/∂ξ_k,   w J⁻ᵀ the cofactors of J
#pragma once

#include "rubato/element/nonlinear.hpp"

namespace rubato::element {

/// Whether the cell is such a one: HEXA8, small strain, full or mean dilatation, no tangent wanted.
bool is_small_hexa8(const CellKind& kind, const CellOutput& output);

/// evaluate() of it.
CellResult evaluate_small_hexa8(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                                const CellOutput& output);

} // namespace rubato::element
