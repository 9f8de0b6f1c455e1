// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/clipping.hpp"

#include <algorithm>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector2d;

/// In squared lengths of the clipping edge.
constexpr double on_edge = 1e-12;

double plane_cross(const Vector2d& a, const Vector2d& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// The part of `subject` to the left of the line from a to b.
void cut(const Polygon& subject, const Vector2d& a, const Vector2d& b, Polygon& kept) {
  kept.clear();
  const Vector2d edge = b - a;
  const double tolerance = on_edge * edge.squaredNorm();
  const auto side = [&](const Vector2d& corner) {
    const double left = plane_cross(edge, corner - a);
    return std::abs(left) <= tolerance ? 0. : left;
  };
  if (subject.size() == 0)
    return;
  double before = side(subject[subject.size() - 1]);
  const Vector2d* from = &subject[subject.size() - 1];
  for (const auto& to : subject.corners()) {
    const double here = side(to);
    if (before * here < 0)
      kept.add(*from + before / (before - here) * (to - *from));
    if (here >= 0)
      kept.add(to);
    before = here;
    from = &to;
  }
}

} // namespace

double signed_area(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += plane_cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * twice;
}

Vector2d mean_corner(const Polygon& polygon) {
  Vector2d sum = Vector2d::Zero();
  for (const auto& corner : polygon.corners())
    sum += corner;
  return sum / static_cast<double>(std::max<std::size_t>(1, polygon.size()));
}

Polygon clip(const Polygon& subject, const Polygon& clipper) {
  Polygon part = subject, next;
  const std::size_t count = clipper.size();
  for (std::size_t i = 0; i < count && part.size() > 0; ++i) {
    cut(part, clipper[i], clipper[(i + 1) % count], next);
    std::swap(part, next);
  }
  return part;
}

std::size_t fan(const Polygon& polygon, std::array<Triangle, Polygon::capacity>& triangles) {
  const std::size_t count = polygon.size();
  if (count < 3)
    return 0;
  const Vector2d middle = mean_corner(polygon);
  const auto triangle = [&](const std::array<std::size_t, 3>& indices) {
    const auto corner = [&](std::size_t i) { return i < count ? polygon[i] : middle; };
    const Vector2d a = corner(indices[0]), b = corner(indices[1]), c = corner(indices[2]);
    return Triangle{{a, b, c}, 0.5 * plane_cross(b - a, c - a), indices};
  };
  if (count == 3) {
    triangles[0] = triangle({0, 1, 2});
    return 1;
  }
  for (std::size_t i = 0; i < count; ++i)
    triangles[i] = triangle({count, i, (i + 1) % count});
  return count;
}

} // namespace rubato::contact::mortar
