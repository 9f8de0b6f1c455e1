// SPDX-License-Identifier: LGPL-3.0-or-later
/// Boxes that are asked which of them have a place.
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace rubato::mesh {

/// A tree of boxes, each split in two by the middles of its boxes along its longest axis.
class BoxTree {
public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Eigen::AlignedBox3d> boxes);

  /// The boxes that have the place, by their indices, ascending.
  std::vector<std::int32_t> boxes_at(const Eigen::Vector3d& place) const;

private:
  struct Branch {
    Eigen::AlignedBox3d box;
    std::size_t begin = 0; ///< of its boxes in `order_`
    std::size_t end = 0;
    std::size_t right = 0; ///< its second branch, the first follows it; 0: it is a leaf
  };
  void grow(std::size_t begin, std::size_t end);

  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Branch> branches_;
};

} // namespace rubato::mesh
