// SPDX-License-Identifier: LGPL-3.0-or-later
/// Cumulated slip and friction work of contact points since a run began, and what the next step needs for it.
#pragma once

#include "rubato/contact/stencil.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace rubato::contact {

/// Of one contact point, since the run began.
struct FrictionHistory {
  double slip = 0; ///< Σ |Δs| of the steps at whose ends the point was closed [length]
  double work = 0; ///< that friction has taken [force · length]

  bool operator==(const FrictionHistory&) const = default;
};

/// Forces of a zone's points at the end of a step, as they were spread over the nodes: the next step
/// moves these nodes against them.
class PointForces {
public:
  void clear();
  /// `force`: of the master on the slave [force].
  void add(std::size_t point, const Eigen::Vector3d& force, const Stencil& stencil);

  std::size_t count() const { return points_.size(); }
  std::size_t point(std::size_t entry) const { return static_cast<std::size_t>(points_[entry]); }
  Eigen::Vector3d force(std::size_t entry) const { return Eigen::Vector3d::Map(forces_.data() + 3 * entry); }
  /// Σ weight · value(node): of the slave point relative to the place it faced.
  template <class Value> Eigen::Vector3d sum(std::size_t entry, const Value& value) const {
    Eigen::Vector3d total = Eigen::Vector3d::Zero();
    const auto first = static_cast<std::size_t>(entry == 0 ? 0 : ends_[entry - 1]);
    for (auto i = first; i < static_cast<std::size_t>(ends_[entry]); ++i)
      total += weights_[i] * value(nodes_[i]);
    return total;
  }

  /// Shows all that it holds to an archive, which writes or replaces it.
  template <class Visit> void exchange(const Visit& visit) {
    visit("points", points_);
    visit("ends", ends_);
    visit("nodes", nodes_);
    visit("weights", weights_);
    visit("forces", forces_);
  }
  bool operator==(const PointForces&) const = default;

private:
  std::vector<int> points_; ///< an entry each
  std::vector<int> ends_;   ///< of each entry's nodes in the lists of nodes
  std::vector<mesh::NodeIndex> nodes_;
  std::vector<double> weights_;
  std::vector<double> forces_; ///< three an entry
};

} // namespace rubato::contact
