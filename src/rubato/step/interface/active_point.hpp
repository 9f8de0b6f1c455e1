// SPDX-License-Identifier: LGPL-3.0-or-later
/// A point in contact as the points' linear system sees it: linearised, its own multipliers eliminated. Those
/// that it shares with other points stay (shared_multipliers.hpp).
#pragma once

#include "rubato/contact/point_tangent.hpp"
#include "rubato/step/interface/active_interface_compliance.hpp"
#include "rubato/step/interface/shared_multipliers.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace rubato::step {

struct ActivePoint {
  std::size_t zone = 0;
  std::size_t index = 0;
  std::vector<MultiplierShare> shares; ///< empty where the point owns its multipliers
  /// Its columns are those displacements that no support holds, once the system has been solved.
  contact::FactoredResponse response;
  std::vector<int> interface_dofs; ///< of those columns, on the surface
  /// What is left of the equations: A₁ δz + A₂ δq = b and δξ − P δq = 0. Where multipliers are shared
  /// δz − Z_q δq = Z_m δm.
  PointRows rows;                                                          ///< A₂ over −P, and N over H
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> by_force; ///< A₁
  contact::PointVector right;                                              ///< b
  /// Of Z_m over E_m, to the left.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 6> inverse;
  Eigen::Index first = 0;       ///< of its δz among those of all points
  Eigen::Index first_slope = 0; ///< of its δξ

  int components() const { return response.components; }
  int n_xi() const { return response.n_xi; }
};

/// The largest magnitude.
template <class Matrix> double largest_of_row(const Matrix& matrix, Eigen::Index row) {
  double largest = 0;
  for (Eigen::Index column = 0; column < matrix.cols(); ++column)
    largest = std::max(largest, std::abs(matrix(row, column)));
  return largest;
}

/// Takes the combinations of δz − Z_q δq − Z_m δm = 0 and −E_q δq − E_m δm = e that have no δm.
void eliminate_multipliers(ActivePoint& point);

/// Keeps them: δz − Z_q δq = Z_m δm.
void keep_multipliers(ActivePoint& point);

/// Combines the equations of δz so that they depend on the point alone, not on how its multipliers were
/// eliminated: unit columns at pivots among A₁ and `compliance` A₂, `compliance` what a force moves
/// [length/force]. Points that differ little then have equations that differ little.
void reduce_equations(ActivePoint& point, double compliance);

/// δm of a point whose force changes by `force`, one a component, while the surface moves by `moved`, one an
/// interface dof.
contact::PointVector multiplier_change(const ActivePoint& point, std::span<const double> force,
                                       const Eigen::VectorXd& moved);

} // namespace rubato::step
