// SPDX-License-Identifier: LGPL-3.0-or-later
/// Boxes that are asked which of them have a place.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace rubato::mesh {

/// A box along the axes, its bounds included. Empty at first.
struct Box {
  Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector3d largest = Eigen::Vector3d::Constant(std::numeric_limits<double>::lowest());

  void extend(const Eigen::Vector3d& place);
  void extend(const Box& other);
  bool contains(const Eigen::Vector3d& place) const;
};

/// A tree of boxes, each split in two by the middles of its boxes along its longest axis.
class BoxTree {
public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> boxes);

  /// The boxes that have the place, by their indices, ascending.
  std::vector<std::int32_t> boxes_at(const Eigen::Vector3d& place) const;

private:
  struct Branch {
    Box box;
    std::size_t begin = 0; ///< of its boxes in `order_`
    std::size_t end = 0;
    std::size_t right = 0; ///< its second branch, the first follows it; 0: it is a leaf
  };
  void grow(std::size_t begin, std::size_t end);

  std::vector<Box> boxes_;
  std::vector<std::int32_t> order_;
  std::vector<Branch> branches_;
};

} // namespace rubato::mesh
