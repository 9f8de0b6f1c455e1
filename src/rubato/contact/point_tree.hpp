// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of a surface by where they are: the one search tree of contact.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace rubato::contact {

/// A k-d tree of points that stay where they are; they must outlive it.
class PointTree {
public:
  /// At least one point.
  explicit PointTree(std::span<const Eigen::Vector3d> points);
  ~PointTree();
  PointTree(const PointTree&) = delete;
  PointTree& operator=(const PointTree&) = delete;

  struct Nearest {
    std::size_t index = 0;
    double squared_distance = 0; ///< [length²]
  };
  /// Of equally near points any.
  Nearest nearest(const Eigen::Vector3d& x) const;

  /// Appends the indices of all points nearer to `x` than that, in any order.
  void append_within(const Eigen::Vector3d& x, double distance, std::vector<std::uint32_t>& indices) const;

private:
  struct Index;
  std::unique_ptr<Index> index_;
};

} // namespace rubato::contact
