// SPDX-License-Identifier: LGPL-3.0-or-later
/// The motion at the first instant of a run.
#pragma once

#include <Eigen/Core>

namespace rubato::model {

/// Displacements and velocities the deck gives the bodies at the first instant, one a dof; supports count
/// before them.
struct InitialMotion {
  Eigen::VectorXd displacement; ///< [length]
  Eigen::VectorXd velocity;     ///< [length/time]
};

} // namespace rubato::model
