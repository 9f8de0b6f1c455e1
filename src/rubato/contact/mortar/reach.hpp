// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far slave faces look for their masters in a step.
///
/// Surfaces that are apart by more than the longest slave face have nothing to do with each other, unless
/// they come to meet within the step: an iterate may have put one far behind the other. And what is behind
/// the master where the step begins must be found there, however deep. Looking farther than that would let a
/// face meet the layers behind the one that it faces, or the far side of a body from within.
#pragma once

#include "rubato/contact/mortar/segments.hpp"
#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::contact::mortar {

class ReachInStep {
public:
  /// Both surfaces where the step begins, by position in their nodes; `longest_face` of the slave.
  void begin(const Surface& slave, const Surface& master, std::span<const Eigen::Vector3d> slave_x,
             std::span<const Eigen::Vector3d> master_x, double longest_face);

  /// Of every slave face: the way that slave and master have come relative to each other in the step, twice
  /// the depth of its nodes behind the master where the step begins, and ahead the longest slave face, behind
  /// a quarter of the longest face or edge of both: what facets of curved surfaces may sag into each other.
  /// Valid until the next call.
  std::span<const Reach> at(std::span<const Eigen::Vector3d> slave_x,
                            std::span<const Eigen::Vector3d> master_x);

private:
  std::vector<Eigen::Vector3d> slave_, master_; ///< where the step begins
  std::vector<Reach> resting_;                  ///< of every slave face without motion
  std::vector<Reach> now_;
};

} // namespace rubato::contact::mortar
