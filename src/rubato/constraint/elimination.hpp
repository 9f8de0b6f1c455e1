// SPDX-License-Identifier: LGPL-3.0-or-later
/// Linear equations between displacements, solved for dofs that follow from others.
#pragma once

#include "rubato/constraint/reduction.hpp"

#include <span>
#include <vector>

namespace rubato::constraint {

/// Σ coefficient · u_dof = value at every instant.
struct Equation {
  std::vector<Term> terms; ///< a dof may occur several times
  ImposedValue value;
  int source = 0; ///< what says it, by the caller's numbers
  /// Whether `given` has the number of the equation even if its right side is 0, for Reduction::multipliers.
  bool has_multiplier = false;
};

/// An equation that holds of no displacements: those that it contradicts, and by how much.
struct Contradiction {
  int equation = 0;
  std::vector<int> others; ///< equations, ascending
  std::vector<int> dofs;   ///< prescribed ones, ascending
  double excess = 0;       ///< what is left of it at the instant where that is most
  double at = 0;           ///< that instant
};

struct Elimination {
  std::vector<DependentDof> dependents; ///< for Reduction, with the equations' numbers in `given`
  std::vector<int> redundant;           ///< equations that follow from those before and from supports
  std::vector<Contradiction> contradictions;
};

/// Gauss–Jordan elimination on sparse rows: when prescribed and dependent dofs have been replaced, every
/// equation is solved for its first dof where that has a coefficient of the size of the largest, else for the
/// dof with the largest. An equation of which nothing is left
/// is redundant when its right side follows, too, at all `instants`, else contradicting. `prescribed`:
/// ascending by dof.
Elimination eliminate(std::span<const PrescribedDof> prescribed, std::span<const Equation> equations,
                      std::span<const double> instants);

} // namespace rubato::constraint
