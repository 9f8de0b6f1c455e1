// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/plane_map.hpp"

#include "rubato/cell/reference_cell.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int max_iterations = 20;
/// Residual, in face sizes, that is rounding.
constexpr double rounding = 1e-15;
/// A step after which the next one would be rounding: errors shrink with their square.
constexpr double last_step = 1e-8;
/// Steps that make no sense, in reference lengths.
constexpr double far_away = 8;
/// How far outside, in reference lengths, a place still belongs to the face.
constexpr double outside = 0.5;

double determinant_of(const FacePolynomial::Place& at) {
  return at.by_first[0] * at.by_second[1] - at.by_first[1] * at.by_second[0];
}

/// The Newton step to a point of the plane.
Vector2d step_by(const FacePolynomial::Place& at, const Vector2d& left) {
  const double inverse = 1 / determinant_of(at);
  return {inverse * (left[0] * at.by_second[1] - left[1] * at.by_second[0]),
          inverse * (at.by_first[0] * left[1] - at.by_first[1] * left[0])};
}

void set_values(CellType type, const Vector2d& xi, std::array<double, 9>& values) {
  if (cell::topology(type).order == 2) {
    values = face_values(type, xi);
    return;
  }
  if (type == CellType::tria3) {
    values[0] = 1 - xi[0] - xi[1];
    values[1] = xi[0];
    values[2] = xi[1];
    return;
  }
  const double left = 0.5 * (1 - xi[0]), right = 0.5 * (1 + xi[0]);
  const double below = 0.5 * (1 - xi[1]), above = 0.5 * (1 + xi[1]);
  values[0] = left * below;
  values[1] = right * below;
  values[2] = right * above;
  values[3] = left * above;
}

bool belongs_to(CellType type, const Vector2d& xi) {
  if (cell::topology(type).corner_count == 3)
    return std::min({xi[0], xi[1], 1 - xi[0] - xi[1]}) >= -outside;
  return xi.lpNorm<Eigen::Infinity>() <= 1 + outside;
}

} // namespace

PlaneMap::PlaneMap(CellType type, const FaceCoordinates& local)
    : type_(type), local_(local), polynomial_(type, local) {
  const Vector3d first = local.col(0);
  size_ = std::sqrt((local.colwise() - first).colwise().squaredNorm().maxCoeff()) + first.head<2>().norm();
}

PlanePlace PlaneMap::place_at(const Vector2d& xi) const {
  const auto at = polynomial_.at(xi);
  PlanePlace place{
      .xi = xi, .values = {}, .height = at.position[2], .determinant = determinant_of(at), .found = true};
  set_values(type_, xi, place.values);
  return place;
}

PlanePlace PlaneMap::place_of(const Vector2d& p, const Vector2d& start) const {
  PlanePlace place;
  place.xi = start;
  const double small = rounding * size_;
  bool last = false;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const auto at = polynomial_.at(place.xi);
    const Vector2d left = p - at.position.head<2>();
    place.height = at.position[2];
    place.determinant = determinant_of(at);
    if (last || left.lpNorm<Eigen::Infinity>() <= small) {
      place.found = belongs_to(type_, place.xi);
      break;
    }
    const Vector2d step = step_by(at, left);
    const double length = step.lpNorm<Eigen::Infinity>();
    if (!(length <= far_away))
      break;
    place.xi += step;
    last = length <= last_step;
  }
  if (place.found)
    set_values(type_, place.xi, place.values);
  return place;
}

} // namespace rubato::contact::mortar
