// SPDX-License-Identifier: LGPL-3.0-or-later
/// Forces of one bulk cell over a step that keep energy and momenta: J. C. Simo, N. Tarnow, The discrete
/// energy-momentum method, ZAMP 43 (1992) 757–792; O. Gonzalez, Exact energy and momentum conserving
/// algorithms for general models in nonlinear elasticity, CMAME 190 (2000) 1763–1783.
///
/// {x} and [x] are mean and change over the step. With U of the cell as a function of C = FᵀF at its points
/// and S_½ the stresses conjugate to it at {C},
///
///   g = ([U] − Σ w S_½:½[C]) / Σ w ¼[C]:[C]      f = Σ w (∂F/∂u)ᵀ:({F}(S_½ + ½ g [C]))
///
/// so that [u]·f = [U] but for rounding, and, S being symmetric, the moment of f about {x} is zero in space.
/// Small strain: the forces at {u}, for which the same holds where the law is linear.
///
/// For laws without memory; in plane stress they remember E_zz. The cell's own unknowns of `enhanced` with
/// Green–Lagrange's strain follow from forces on them that are formed in the same way and vanish: they are
/// those of the step, near those that `evaluate` finds at its end.
#pragma once

#include "rubato/element/nonlinear.hpp"

#include <span>

namespace rubato::element {

/// Whether there are such forces: what is_offered, without formulations that are not named above in finite
/// strain.
bool is_offered_between(const CellKind& kind);

struct BetweenInput {
  std::span<const Eigen::Vector3d> points; ///< of the undeformed cell
  std::span<const double> before;          ///< displacements at the start of the step, nodes · d
  std::span<const double> after;           ///< at its end
  std::span<const double> old;             ///< state_size_of_cell numbers, at the start
  material::StepInfo step = {};
  ModeIteration modes = {};
  /// As in CellInput, of the middle of the step: it counts for both ends, so that [U] is without its change.
  std::span<const material::Strain6> free_strain = {};
};

/// Where results go; what is empty is not wanted.
struct BetweenOutput {
  std::span<double> now;                ///< state_size_of_cell numbers at the end, not the memory of `old`
  std::span<double> force;              ///< f, nodes · d; never empty
  std::span<double> tangent = {};       ///< near ∂f/∂(after), symmetric, square of nodes · d
  std::span<double> exact_tangent = {}; ///< ∂f/∂(after), not symmetric, column after column
  std::span<PointRecord> records = {};  ///< at the end of the step, one a point
};

struct BetweenResult {
  CellResult after;         ///< of the end; its failure is that of the step
  double stored_before = 0; ///< U at the start: [u]·f is after.stored − stored_before

  explicit operator bool() const { return static_cast<bool>(after); }
};

/// Evaluates a cell over a step. Where it fails, what was written has no meaning. Throws
/// std::invalid_argument for a kind that is not offered.
BetweenResult evaluate_between(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                               const BetweenOutput& output);

} // namespace rubato::element
