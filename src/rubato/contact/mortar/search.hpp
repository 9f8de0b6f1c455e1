// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which faces are near a face: boxes in a tree.
#pragma once

#include "rubato/contact/projection.hpp"

#include <Eigen/Geometry>

#include <memory>
#include <span>
#include <vector>

namespace rubato::contact::mortar {

using Box = Eigen::AlignedBox3d;

/// A box that holds a face: that of its nodes, of a quadratic face grown by a quarter, as it may bulge.
Box box_of(CellType type, const FaceCoordinates& x);

/// A tree of boxes, made anew for each configuration.
class FaceSearch {
public:
  FaceSearch();
  ~FaceSearch();
  FaceSearch(FaceSearch&&) noexcept;
  FaceSearch& operator=(FaceSearch&&) noexcept;

  void build(std::span<const Box> boxes);
  /// The indices of all boxes that meet `box`, ascending.
  void find(const Box& box, std::vector<int>& found) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

} // namespace rubato::contact::mortar
