// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/group_region.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;
using study::GroupKind;

Vector3d vector(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

double from_box(const study::MadeGroup& box, const Vector3d& place) {
  const Vector3d below = vector(box.from) - place;
  const Vector3d above = place - vector(box.to);
  return below.cwiseMax(above).cwiseMax(0).norm();
}

/// `beyond` is the signed distance from the surface of a round body, > 0 outside.
double from_round(const study::MadeGroup& shape, double beyond) {
  return std::max(0.0, shape.within ? std::abs(beyond) - *shape.within : beyond);
}

} // namespace

double distance_from(const study::MadeGroup& shape, const Vector3d& place) {
  const Vector3d from_point = place - vector(shape.point);
  switch (shape.kind) {
  case GroupKind::box:
    return from_box(shape, place);
  case GroupKind::sphere:
    return from_round(shape, from_point.norm() - shape.radius);
  case GroupKind::cylinder: {
    const Vector3d axis = vector(shape.direction).normalized();
    return from_round(shape, (from_point - axis.dot(from_point) * axis).norm() - shape.radius);
  }
  case GroupKind::plane:
    return std::max(0.0, std::abs(vector(shape.direction).normalized().dot(from_point)) -
                             shape.within.value_or(0));
  default:
    throw std::logic_error("found a group that is no shape");
  }
}

} // namespace rubato::mesh
