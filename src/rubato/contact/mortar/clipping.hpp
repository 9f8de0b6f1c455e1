// SPDX-License-Identifier: LGPL-3.0-or-later
/// Polygons in an auxiliary plane, their intersection, and the triangles it is integrated on.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>

namespace rubato::contact::mortar {

/// At most sixteen corners, in order. Two quadrangles have eight at most; more come from clippers that are
/// not convex, whose last corners are left out beyond sixteen.
class Polygon {
public:
  static constexpr std::size_t capacity = 16;

  void clear() { count_ = 0; }
  void add(const Eigen::Vector2d& corner) {
    if (count_ < capacity)
      corners_[count_++] = corner;
  }
  std::size_t size() const { return count_; }
  const Eigen::Vector2d& operator[](std::size_t i) const { return corners_[i]; }
  std::span<const Eigen::Vector2d> corners() const { return std::span(corners_).first(count_); }

private:
  std::array<Eigen::Vector2d, capacity> corners_;
  std::size_t count_ = 0;
};

/// Positive when the corners run counter-clockwise.
double signed_area(const Polygon& polygon);
Eigen::Vector2d mean_corner(const Polygon& polygon);

/// The part of `subject` inside `clipper`, both counter-clockwise (I. Sutherland, G. Hodgman, Commun. ACM 17
/// (1974) 32–42). Corners within 1e-12 of a clipping edge's squared length, measured as the cross product,
/// lie on it. Exact for a convex clipper.
Polygon clip(const Polygon& subject, const Polygon& clipper);

/// A triangle of a polygon, and its area with sign.
struct Triangle {
  std::array<Eigen::Vector2d, 3> corners;
  double area = 0;
  std::array<std::size_t, 3> indices{}; ///< of the corners in the polygon; its size for the mean of them
};

/// A triangle as it is, any other polygon as a fan around the mean of its corners. Areas keep their sign: a
/// polygon that is not convex has negative triangles, which belong to its area. Empty below three corners.
/// The result holds up to Polygon::capacity triangles; returns how many.
std::size_t fan(const Polygon& polygon, std::array<Triangle, Polygon::capacity>& triangles);

} // namespace rubato::contact::mortar
