// SPDX-License-Identifier: LGPL-3.0-or-later
/// Springs and dashpots whose force is a table.
#pragma once

#include "rubato/core/linear_table.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::domain {

/// A force s(e) by e = row · x of `dofs`, x displacements or velocities: rowᵀ s on these dofs. The matrix of
/// the whole has `held` rowᵀ row of it.
struct LawSpring {
  std::vector<int> dofs;
  Eigen::VectorXd row;
  LinearTable force; ///< by e
  double held = 0;   ///< [force/length], of dashpots [force · time/length]

  double stretch(const Eigen::VectorXd& x) const;
};

/// Adds what the matrix lacks of the forces, rowᵀ (s(e) − held e).
void add_beyond_matrix(std::span<const LawSpring> springs, const Eigen::VectorXd& x, Eigen::VectorXd& forces);

/// Σ ∫ s de − ½ e s: what ½ x·(forces) lacks of the stored energy [force · length].
double energy_beyond_products(std::span<const LawSpring> springs, const Eigen::VectorXd& u);

/// Σ ½ (s₀ + s₁)(e₁ − e₀) − ∫ s de from e₀ to e₁: what forces at both ends of a step miss of the work between
/// them [force · length]; 0 of straight lines.
double missed_between(std::span<const LawSpring> springs, const Eigen::VectorXd& u0,
                      const Eigen::VectorXd& u1);

} // namespace rubato::domain
