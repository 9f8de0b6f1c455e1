// SPDX-License-Identifier: LGPL-3.0-or-later
/// Forces of springs and dashpots to a ground that moves.
#pragma once

#include "rubato/core/field_function.hpp"

#include <Eigen/Core>

namespace rubato::model {

/// What springs and dashpots to the ground do to the bodies when it moves by s along an axis: the force
/// stiffness s + damping ṡ.
struct GroundPull {
  FieldFunction displacement; ///< s [length]
  Eigen::VectorXd along;      ///< r: 1 on dofs along the axis
  Eigen::VectorXd stiffness;  ///< K r [force/length], one a dof
  Eigen::VectorXd damping;    ///< C r [force · time/length], one a dof; empty without damping

  double at(double t) const;   ///< s [length]
  double rate(double t) const; ///< ṡ [length/time]
};

} // namespace rubato::model
