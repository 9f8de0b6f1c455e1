// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the folder only: which points of a slave sub-facet face what it can touch.
///
/// A sub-facet may see several layers of its master within reach, one behind the other, or a step of it. What
/// is behind the nearest layer is left out. What is beside it without a connection, and farther away by a
/// good part of the sub-facet, cannot touch before the sub-facet has been pushed through what is near: its
/// weight falls from 1 at a quarter of the sub-facet's size to 0 at a half, without a jump.
#pragma once

#include "rubato/contact/mortar/segments.hpp"
#include "rubato/contact/surface.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace rubato::contact::mortar {

/// The points before one master face.
struct PointRange {
  int master_face = 0;
  std::size_t first = 0, last = 0;               ///< in OverlapPoints::points
  std::size_t first_corner = 0, last_corner = 0; ///< in OverlapPoints::corners

  /// Its entries of something that all points have.
  template <class Value> std::span<Value> of(std::span<Value> values) const {
    return values.subspan(first, last - first);
  }
  std::span<const Corner> of_corners(std::span<const Corner> corners) const {
    return corners.subspan(first_corner, last_corner - first_corner);
  }
};

/// How far a master face is from the slave at ξ, as Point::distance; nothing where it is not before ξ.
using DistanceBefore = std::function<std::optional<double>(int master_face, const Eigen::Vector2d& xi)>;

/// The largest distance of two nodes of a sub-facet [length].
double size_of(const SlaveFace& placed, const SubFacet& facet);

/// Sets weights to 0 where a master face without a common node is nearer. Does nothing while the weights are
/// at most the area of the sub-facet: then there are no layers.
void leave_out_hidden(const Surface& master, std::span<const PointRange> ranges, double full_area,
                      const DistanceBefore& distance_before, std::span<Point> points);

/// Lowers the weights before master faces that are connected with none that is near: from a distance of a
/// quarter of `size` [length] behind the nearest point of all on, to 0 at a half.
void leave_out_far(const Surface& master, std::span<const PointRange> ranges, double size,
                   std::span<Point> points);

} // namespace rubato::contact::mortar
