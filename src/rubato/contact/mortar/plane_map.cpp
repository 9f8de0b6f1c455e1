// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/plane_map.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

/// One Newton step of all points, and how far they have come. Conditions are numbers, 1 or 0, for vector
/// instructions: compilers make none of branches.
struct Round {
  PlanePlaces::Numbers left;                    ///< of the way in the plane
  PlanePlaces::Numbers first_step, second_step; ///< of ξ
  PlanePlaces::Numbers moving, last; ///< whether the point moves on, and whether this was its last step

  bool is_moving(std::size_t count) const {
    return std::find(moving.begin(), moving.begin() + static_cast<std::ptrdiff_t>(count), 1.) !=
           moving.begin() + static_cast<std::ptrdiff_t>(count);
  }
};

template <FaceTerms terms> void take_steps(const FacePolynomial& face, PlanePlaces& places, Round& round) {
  for (std::size_t i = 0; i < places.count; ++i) {
    const double s = places.xi[0][i], t = places.xi[1][i];
    const auto x = face.coordinate<terms>(0, s, t), y = face.coordinate<terms>(1, s, t);
    const double left_x = places.p[0][i] - x.value, left_y = places.p[1][i] - y.value;
    const double determinant = x.by_first * y.by_second - y.by_first * x.by_second;
    const double inverse = 1 / determinant;
    places.determinant[i] = determinant;
    round.left[i] = std::max(std::abs(left_x), std::abs(left_y));
    round.first_step[i] = inverse * (left_x * y.by_second - left_y * x.by_second);
    round.second_step[i] = inverse * (x.by_first * left_y - y.by_first * left_x);
  }
}

/// Points that have arrived, or whose step makes no sense, stay where they are.
void move(double small, PlanePlaces& places, Round& round) {
  for (std::size_t i = 0; i < places.count; ++i) {
    const double first = round.first_step[i], second = round.second_step[i];
    const double length = std::max(std::abs(first), std::abs(second));
    const double arrived = round.left[i] <= small ? 1 : round.last[i];
    const double sensible = length <= far_away ? 1 : 0;
    const double moving = round.moving[i] * (1 - arrived) * sensible;
    places.found[i] = std::max(places.found[i], round.moving[i] * arrived);
    places.xi[0][i] += moving > 0 ? first : 0;
    places.xi[1][i] += moving > 0 ? second : 0;
    round.last[i] = length <= last_step ? 1 : 0;
    round.moving[i] = moving;
  }
}

template <FaceTerms terms> void set_heights(const FacePolynomial& face, PlanePlaces& places) {
  for (std::size_t i = 0; i < places.count; ++i)
    places.height[i] = face.coordinate<terms>(2, places.xi[0][i], places.xi[1][i]).value;
}

bool belongs_to(bool triangle, const Vector2d& xi) {
  if (triangle)
    return std::min({xi[0], xi[1], 1 - xi[0] - xi[1]}) >= -outside;
  return std::max(std::abs(xi[0]), std::abs(xi[1])) <= 1 + outside;
}

} // namespace

PlaneMap::PlaneMap(CellType type, const FaceCoordinates& local)
    : type_(type), cell_(&cell::reference_cell(type)), local_(local), polynomial_(type, local) {
  const Vector3d first = column_of(local, 0);
  double farthest = 0;
  for (Eigen::Index node = 1; node < local.cols(); ++node) {
    const Vector3d apart = difference_of(column_of(local, node), first);
    farthest = std::max(farthest, dot(apart, apart));
  }
  size_ = std::sqrt(farthest) + std::sqrt(first[0] * first[0] + first[1] * first[1]);
}

PlanePlace PlaneMap::place_at(const Vector2d& xi) const {
  const auto at = polynomial_.at(xi);
  return {.xi = xi,
          .height = at.position[2],
          .determinant = at.by_first[0] * at.by_second[1] - at.by_first[1] * at.by_second[0],
          .found = true};
}

void PlaneMap::find(PlanePlaces& places) const {
  polynomial_.with_terms([&]<FaceTerms terms>() {
    iterate<terms>(places);
    set_heights<terms>(polynomial_, places);
  });
}

template <FaceTerms terms> void PlaneMap::iterate(PlanePlaces& places) const {
  const double small = rounding * size_;
  Round round;
  round.moving.fill(1);
  round.last.fill(0);
  places.found.fill(0);
  for (int iteration = 0; iteration < max_iterations && round.is_moving(places.count); ++iteration) {
    take_steps<terms>(polynomial_, places, round);
    move(small, places, round);
  }
  const bool triangle = cell::topology(type_).corner_count == 3;
  for (std::size_t i = 0; i < places.count; ++i)
    if (!belongs_to(triangle, places.xi_at(i)))
      places.found[i] = 0;
}

void PlaneMap::set_values(const Vector2d& xi, std::array<double, 9>& values) const {
  if (polynomial_.terms() != FaceTerms::bilinear) {
    cell_->values({xi[0], xi[1], 0}, values);
    return;
  }
  if (type_ == CellType::tria3) {
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

} // namespace rubato::contact::mortar
