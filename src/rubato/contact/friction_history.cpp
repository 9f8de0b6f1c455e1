// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/friction_history.hpp"

namespace rubato::contact {

/// Each step fills the storage of the step before.
void PointForces::clear() {
  points_.clear();
  ends_.clear();
  nodes_.clear();
  weights_.clear();
  forces_.clear();
}

void PointForces::add(std::size_t point, const Eigen::Vector3d& force, const Stencil& stencil) {
  points_.push_back(static_cast<int>(point));
  forces_.insert(forces_.end(), force.begin(), force.end());
  nodes_.insert(nodes_.end(), stencil.nodes.begin(), stencil.nodes.end());
  weights_.insert(weights_.end(), stencil.weights.begin(), stencil.weights.end());
  ends_.push_back(static_cast<int>(nodes_.size()));
}

} // namespace rubato::contact
