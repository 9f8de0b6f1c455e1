// SPDX-License-Identifier: LGPL-3.0-or-later
/// A gauge: a spring on one rigid motion of a body that nothing else resists.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::model {

/// Holds a motion of a body that nothing resists, and neither the body's other rigid motions nor, but for
/// places near its nodes, deformations: a spring on g·u, slack at 0.
struct Gauge {
  std::vector<mesh::NodeIndex> nodes;
  Eigen::VectorXd values; ///< of g, node by node
};

} // namespace rubato::model
