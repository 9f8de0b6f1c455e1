// SPDX-License-Identifier: LGPL-3.0-or-later
/// Shape functions at the points of a rule with the nodes next to each other in memory, their number made
/// even by zeros: two nodes are one SSE2 register.
#pragma once

#include "rubato/element/lower_order.hpp"

#include <Eigen/Core>

namespace rubato::element {

constexpr int even(int count) {
  return count + count % 2;
}

struct ReferenceGradients {
  int nodes = 0;
  int points = 0;
  Eigen::VectorXd weights;
  Eigen::MatrixXd values;    ///< even(nodes) × points
  Eigen::MatrixXd gradients; ///< ∂N_i/∂ξ_a in column q · dimension + a
  Eigen::Matrix3Xd xi;       ///< places of the points
  Eigen::MatrixXd centre;    ///< nodes × dimension: ∂N_i/∂ξ_a at ξ = 0
  Eigen::VectorXd centre_values;
};

/// The points at which a cell evaluates its law.
enum class PointRule {
  stiffness,   ///< cell::stiffness_rule
  lower_order, ///< lower_order_rule
  one          ///< one point with the means of the gradients over the volume: QUAD4 and HEXA8
};

/// Returns the table of a rule other than `one`. Throws std::invalid_argument for cells without mechanics,
/// and for cells without such a rule.
const ReferenceGradients& reference_gradients(CellType type, PointRule rule = PointRule::stiffness);

} // namespace rubato::element
