// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far slave faces look for their masters in a step.
///
/// Surfaces that are apart by more than the longest slave face have nothing to do with each other, unless
/// they come to meet within the step: an iterate may have put one far behind the other. And what is behind
/// the master where the step begins must be found there, however deep. Looking farther than that would let a
/// face meet the layers behind the one that it faces.
#pragma once

#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::contact::mortar {

class Reach {
public:
  /// Both surfaces where the step begins, by position in their nodes; `longest_face` of the slave.
  void begin(const Surface& slave, const Surface& master, std::span<const Eigen::Vector3d> slave_x,
             std::span<const Eigen::Vector3d> master_x, double longest_face);

  /// Of every slave face [length]: the longest face, the way that slave and master have come relative to each
  /// other in the step, and twice the depth of its nodes behind the master where the step begins. Valid until
  /// the next call.
  std::span<const double> at(std::span<const Eigen::Vector3d> slave_x,
                             std::span<const Eigen::Vector3d> master_x);

private:
  std::vector<Eigen::Vector3d> slave_, master_; ///< where the step begins
  std::vector<double> resting_;                 ///< of every slave face without motion
  std::vector<double> now_;
};

} // namespace rubato::contact::mortar
