// SPDX-License-Identifier: LGPL-3.0-or-later
/// A load of a model.
#pragma once

#include "rubato/core/function.hpp"
#include "rubato/load/field_forces.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace rubato::model {

/// A force pattern times a function of time (1 when there is none), and what of the load changes otherwise.
struct Force {
  Eigen::VectorXd pattern; ///< [force], one a dof
  std::optional<Function> function;
  std::vector<load::FieldForce> fields = {}; ///< expressions of t
  bool is_controlled = false;                ///< multiplied by the factor of the loads
};

} // namespace rubato::model
