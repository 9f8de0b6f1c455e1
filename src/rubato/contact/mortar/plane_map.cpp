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

bool is_bilinear(CellType type) {
  return type == CellType::tria3 || type == CellType::quad4;
}

/// Position and derivatives at a place.
struct Evaluation {
  Vector3d position;
  Vector3d by_first, by_second;

  double determinant() const { return by_first[0] * by_second[1] - by_first[1] * by_second[0]; }
  /// The Newton step to a point of the plane.
  Vector2d step(const Vector2d& left) const {
    const double inverse = 1 / determinant();
    return {inverse * (left[0] * by_second[1] - left[1] * by_second[0]),
            inverse * (by_first[0] * left[1] - by_first[1] * left[0])};
  }
};

Evaluation evaluate(const Eigen::Matrix<double, 3, 4>& factors, const Vector2d& xi) {
  const Vector3d by_first = factors.col(1) + xi[1] * factors.col(3);
  const Vector3d by_second = factors.col(2) + xi[0] * factors.col(3);
  return {factors.col(0) + xi[0] * by_first + xi[1] * factors.col(2), by_first, by_second};
}

Evaluation evaluate(CellType type, const FaceCoordinates& local, const Vector2d& xi,
                    std::array<double, 9>& values) {
  const auto& cell = cell::reference_cell(type);
  const auto count = static_cast<std::size_t>(cell.node_count);
  std::array<double, 18> gradients;
  const Vector3d at(xi[0], xi[1], 0);
  cell.values(at, std::span(values).first(count));
  cell.gradients(at, std::span(gradients).first(2 * count));
  Evaluation sum{Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
  for (std::size_t i = 0; i < count; ++i) {
    const auto node = local.col(static_cast<Eigen::Index>(i));
    sum.position += values[i] * node;
    sum.by_first += gradients[2 * i] * node;
    sum.by_second += gradients[2 * i + 1] * node;
  }
  return sum;
}

void set_bilinear_values(CellType type, const Vector2d& xi, std::array<double, 9>& values) {
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

PlaneMap::PlaneMap(CellType type, const FaceCoordinates& local) : type_(type), local_(local) {
  const Vector3d first = local.col(0);
  size_ = std::sqrt((local.colwise() - first).colwise().squaredNorm().maxCoeff()) + first.head<2>().norm();
  if (type == CellType::tria3) {
    bilinear_ << first, local.col(1) - first, local.col(2) - first, Vector3d::Zero();
  } else if (type == CellType::quad4) {
    const Vector3d below = 0.25 * (first + local.col(1)), above = 0.25 * (local.col(2) + local.col(3));
    const Vector3d along = 0.25 * (local.col(1) - first), back = 0.25 * (local.col(2) - local.col(3));
    bilinear_ << above + below, back + along, above - below, back - along;
  }
}

PlanePlace PlaneMap::place_at(const Vector2d& xi) const {
  PlanePlace place;
  place.xi = xi;
  place.found = true;
  Evaluation at;
  if (is_bilinear(type_)) {
    set_bilinear_values(type_, xi, place.values);
    at = evaluate(bilinear_, xi);
  } else {
    at = evaluate(type_, local_, xi, place.values);
  }
  place.height = at.position[2];
  place.determinant = at.determinant();
  return place;
}

PlanePlace PlaneMap::place_of(const Vector2d& p, const Vector2d& start) const {
  PlanePlace place;
  place.xi = start;
  const bool bilinear = is_bilinear(type_);
  const double small = rounding * size_;
  bool last = false;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    const auto at =
        bilinear ? evaluate(bilinear_, place.xi) : evaluate(type_, local_, place.xi, place.values);
    const Vector2d left = p - at.position.head<2>();
    place.height = at.position[2];
    place.determinant = at.determinant();
    if (last || left.lpNorm<Eigen::Infinity>() <= small) {
      place.found = belongs_to(type_, place.xi);
      break;
    }
    const Vector2d step = at.step(left);
    const double length = step.lpNorm<Eigen::Infinity>();
    if (!(length <= far_away))
      break;
    place.xi += step;
    last = length <= last_step;
  }
  if (bilinear)
    set_bilinear_values(type_, place.xi, place.values);
  return place;
}

} // namespace rubato::contact::mortar
