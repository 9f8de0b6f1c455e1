// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/projection.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace rubato::contact {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Projections this near to the border lie on it but for rounding.
constexpr double snap = 1e-12;
constexpr int max_iterations = 30;
constexpr double last_digit = 1e-14;
/// A projection farther outside than this many of the last Newton step doesn't come back inside.
constexpr double steps_outside = 10;
/// Beyond this many face sizes the quadratic shape functions say nothing about the face any more.
constexpr double far_away = 8.0;

void finish(Projection& p) {
  p.overshoot = length_of(difference_of(p.xi, p.clamped));
  if (p.overshoot > snap)
    return;
  p.overshoot = 0;
  p.clamped = p.xi;
  p.clamp_derivative.setIdentity();
}

template <int Dimension> void clamp_to_box(Projection& p) {
  for (int a = 0; a < Dimension; ++a) {
    p.clamped[a] = std::clamp(p.xi[a], -1.0, 1.0);
    if (p.clamped[a] != p.xi[a])
      p.clamp_derivative(a, a) = 0;
  }
}

void clamp_to_triangle(Projection& p) {
  static const std::array<Vector2d, 3> corners{Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1)};
  if (p.xi[0] >= 0 && p.xi[1] >= 0 && p.xi[0] + p.xi[1] <= 1)
    return;
  double best = INFINITY;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto edge = difference_of(corners[(i + 1) % 3], corners[i]);
    const double squared = dot(edge, edge);
    const double along = dot(difference_of(p.xi, corners[i]), edge) / squared;
    const double kept = std::clamp(along, 0.0, 1.0);
    const Vector2d candidate(corners[i][0] + kept * edge[0], corners[i][1] + kept * edge[1]);
    const double distance = length_of(difference_of(p.xi, candidate));
    if (distance >= best)
      continue;
    best = distance;
    p.clamped = candidate;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        p.clamp_derivative(a, b) = kept == along ? edge[a] * edge[b] / squared : 0;
  }
}

/// What a face's arithmetic is compiled for.
template <int Dimension, int Nodes> struct FaceKind {
  static constexpr int dimension = Dimension;
  static constexpr int nodes = Nodes;
  /// The projection on an affine face is one linear equation.
  static constexpr bool affine = Nodes == Dimension + 1;
  static constexpr bool triangle = Dimension == 2 && (Nodes == 3 || Nodes == 6 || Nodes == 7);
};

template <class Visit> auto with_kind(CellType type, const Visit& visit) {
  switch (type) {
  case CellType::seg2:
    return visit(FaceKind<1, 2>{});
  case CellType::seg3:
    return visit(FaceKind<1, 3>{});
  case CellType::tria3:
    return visit(FaceKind<2, 3>{});
  case CellType::tria6:
    return visit(FaceKind<2, 6>{});
  case CellType::tria7:
    return visit(FaceKind<2, 7>{});
  case CellType::quad4:
    return visit(FaceKind<2, 4>{});
  case CellType::quad8:
    return visit(FaceKind<2, 8>{});
  case CellType::quad9:
    return visit(FaceKind<2, 9>{});
  default:
    throw std::invalid_argument("no contact on cells of type " + std::string(cell::topology(type).name));
  }
}

template <class Kind> void clamp(Projection& projection) {
  projection.clamped = projection.xi;
  projection.clamp_derivative.setIdentity();
  if constexpr (Kind::triangle)
    clamp_to_triangle(projection);
  else
    clamp_to_box<Kind::dimension>(projection);
  finish(projection);
}

/// Σ of the nodes, each times every Stride-th of the weights.
template <std::ptrdiff_t Nodes, std::ptrdiff_t Stride>
Vector3d weighted_sum(const FaceCoordinates& nodes, const double* weights) {
  Vector3d sum = weights[0] * nodes.col(0);
  for (std::ptrdiff_t i = 1; i < Nodes; ++i)
    sum += weights[i * Stride] * nodes.col(i);
  return sum;
}

template <class Kind> FaceShape shape_of(const cell::ReferenceCell& cell, const Vector2d& xi) {
  constexpr auto n = static_cast<std::size_t>(Kind::nodes);
  constexpr auto d = static_cast<std::size_t>(Kind::dimension);
  const Vector3d at(xi[0], xi[1], 0);
  FaceShape shape;
  cell.values(at, std::span(shape.values).template first<n>());
  cell.gradients(at, std::span(shape.gradients).template first<n * d>());
  if constexpr (!Kind::affine)
    cell.hessians(at, std::span(shape.hessians).template first<n * d * d>());
  else
    std::fill_n(shape.hessians.begin(), n * d * d, 0.0);
  return shape;
}

void set_tangent(int a, const Vector3d& tangent, FaceGeometry& at) {
  for (int i = 0; i < 3; ++i)
    at.tangents(i, a) = tangent[i];
}

template <class Kind> FaceGeometry geometry_of(const FaceCoordinates& nodes, const FaceShape& shape) {
  constexpr int d = Kind::dimension;
  FaceGeometry at;
  at.position = weighted_sum<Kind::nodes, 1>(nodes, shape.values.data());
  set_tangent(1, Vector3d(0, 0, 1), at);
  for (int a = 0; a < d; ++a)
    set_tangent(a, weighted_sum<Kind::nodes, d>(nodes, shape.gradients.data() + a), at);
  for (auto& row : at.curvatures)
    row.fill(Vector3d(0, 0, 0));
  if constexpr (!Kind::affine) {
    at.curvatures[0][0] = weighted_sum<Kind::nodes, d * d>(nodes, shape.hessians.data());
    if constexpr (d == 2) {
      at.curvatures[0][1] = weighted_sum<Kind::nodes, 4>(nodes, shape.hessians.data() + 1);
      at.curvatures[1][0] = at.curvatures[0][1];
      at.curvatures[1][1] = weighted_sum<Kind::nodes, 4>(nodes, shape.hessians.data() + 3);
    }
  }
  return at;
}

/// Position and derivatives of a face, place after place.
template <class Kind> class FaceMap {
public:
  FaceMap(const FaceCoordinates& nodes, const cell::ReferenceCell& cell) : nodes_(nodes), cell_(cell) {}
  FaceGeometry at(const Vector2d& xi) const { return geometry_of<Kind>(nodes_, shape_of<Kind>(cell_, xi)); }
  Vector3d position(const Vector2d& xi) const {
    std::array<double, 9> values;
    cell_.values({xi[0], xi[1], 0}, std::span(values).template first<Kind::nodes>());
    return weighted_sum<Kind::nodes, 1>(nodes_, values.data());
  }

private:
  const FaceCoordinates& nodes_;
  const cell::ReferenceCell& cell_;
};

/// x = a + ξ b
template <> class FaceMap<FaceKind<1, 2>> {
public:
  FaceMap(const FaceCoordinates& nodes, const cell::ReferenceCell& /*unused*/)
      : a_(scaled(0.5, sum_of(column_of(nodes, 1), column_of(nodes, 0)))),
        b_(scaled(0.5, difference_of(column_of(nodes, 1), column_of(nodes, 0)))) {}
  FaceGeometry at(const Vector2d& xi) const {
    FaceGeometry geometry;
    geometry.position = position(xi);
    set_tangent(0, b_, geometry);
    set_tangent(1, Vector3d(0, 0, 1), geometry);
    for (auto& row : geometry.curvatures)
      row.fill(Vector3d(0, 0, 0));
    return geometry;
  }
  Vector3d position(const Vector2d& xi) const { return sum_of(a_, scaled(xi[0], b_)); }

private:
  Vector3d a_, b_;
};

/// x = a + ξ b + η c + ξη d
template <> class FaceMap<FaceKind<2, 4>> {
public:
  FaceMap(const FaceCoordinates& nodes, const cell::ReferenceCell& /*unused*/) {
    for (int i = 0; i < 3; ++i) {
      const double below = 0.25 * (nodes(i, 0) + nodes(i, 1)), above = 0.25 * (nodes(i, 2) + nodes(i, 3));
      const double along = 0.25 * (nodes(i, 1) - nodes(i, 0)), back = 0.25 * (nodes(i, 2) - nodes(i, 3));
      a_[i] = above + below;
      c_[i] = above - below;
      b_[i] = back + along;
      d_[i] = back - along;
    }
  }
  FaceGeometry at(const Vector2d& xi) const {
    FaceGeometry geometry;
    set_tangent(0, sum_of(b_, scaled(xi[1], d_)), geometry);
    set_tangent(1, sum_of(c_, scaled(xi[0], d_)), geometry);
    geometry.position = position(xi);
    geometry.curvatures[0] = {Vector3d(0, 0, 0), d_};
    geometry.curvatures[1] = {d_, Vector3d(0, 0, 0)};
    return geometry;
  }
  Vector3d position(const Vector2d& xi) const {
    return sum_of(sum_of(a_, scaled(xi[0], sum_of(b_, scaled(xi[1], d_)))), scaled(xi[1], c_));
  }

private:
  Vector3d a_, b_, c_, d_;
};

struct Step {
  Vector2d by;
  bool by_newton;
};

/// A matrix of two rows.
struct Symmetric {
  double m00, m01, m11;

  double determinant() const { return m00 * m11 - m01 * m01; }
  Vector2d solve(const Vector2d& right) const {
    const double inverse = 1 / determinant();
    return {m11 * inverse * right[0] - m01 * inverse * right[1],
            m00 * inverse * right[1] - m01 * inverse * right[0]};
  }
};

/// One Newton step for the stationary distance; the Gauss–Newton matrix stands in where curvature spoils the
/// minimum.
template <class Kind> Step next_step(const FaceGeometry& at, const Vector3d& point) {
  const auto distance = difference_of(point, at.position);
  const auto first = column_of(at.tangents, 0), second = column_of(at.tangents, 1);
  if constexpr (Kind::dimension == 1) {
    const double metric = dot(first, first);
    const double exact = metric - dot(distance, at.curvatures[0][0]);
    const bool minimum = exact > 0.1 * metric;
    return {{dot(distance, first) / (minimum ? exact : metric), 0.0}, minimum};
  } else {
    const Symmetric metric{dot(first, first), dot(first, second), dot(second, second)};
    const Symmetric exact{metric.m00 - dot(distance, at.curvatures[0][0]),
                          metric.m01 - dot(distance, at.curvatures[0][1]),
                          metric.m11 - dot(distance, at.curvatures[1][1])};
    const bool minimum = exact.determinant() > 0.01 * metric.determinant() && exact.m00 > 0;
    const Vector2d slope(dot(first, distance), dot(second, distance));
    return {minimum ? exact.solve(slope) : metric.solve(slope), minimum};
  }
}

/// Whether nothing is left to do after Newton steps of these lengths. Errors shrink with their square: the
/// next step is foreseen from the last two.
bool settled(double before, double now, bool by_newton, double size) {
  return now <= last_digit * size ||
         (by_newton && now < 1e-3 * before && now * now * now <= last_digit * before * before * size);
}

/// How far outside the reference face a place lies at least; ≤ 0 inside.
template <class Kind> double beyond(const Vector2d& xi) {
  if constexpr (Kind::dimension == 1)
    return std::abs(xi[0]) - 1;
  if constexpr (Kind::triangle)
    return std::max({-xi[0], -xi[1], (xi[0] + xi[1] - 1) / std::numbers::sqrt2});
  return std::max(std::abs(xi[0]), std::abs(xi[1])) - 1;
}

template <class Kind>
void iterate(const FaceCoordinates& nodes, const Vector3d& point, Wanted wanted,
             const cell::ReferenceCell& cell, Projection& result) {
  const FaceMap<Kind> face(nodes, cell);
  double before = 0;
  for (int iteration = 0; iteration < max_iterations && !result.converged; ++iteration) {
    const auto at = face.at(result.xi);
    const auto step = next_step<Kind>(at, point);
    if (!std::isfinite(step.by[0]) || !std::isfinite(step.by[1]))
      break;
    for (int a = 0; a < 2; ++a)
      result.xi[a] += step.by[a];
    const double size = length_of(result.xi);
    if (size > far_away)
      result.xi = scaled(far_away / size, result.xi);
    const double length = length_of(step.by);
    result.converged =
        Kind::affine ? size <= far_away : settled(before, length, step.by_newton, std::max(1.0, size));
    // Rounding keeps the last digit moving on long faces; a step of a few of them changes nothing any more.
    if (iteration > 6 && length <= 1e-11)
      result.converged = true;
    const bool given_up =
        wanted == Wanted::inside && step.by_newton && beyond<Kind>(result.xi) > steps_outside * length;
    if (Kind::affine || given_up)
      break;
    before = length;
  }
}

} // namespace

FaceShape face_shape(CellType type, const Vector2d& xi) {
  const auto& cell = cell::reference_cell(type);
  return with_kind(type, [&](auto kind) { return shape_of<decltype(kind)>(cell, xi); });
}

FaceGeometry face_geometry(CellType type, const FaceCoordinates& nodes, const FaceShape& shape) {
  return with_kind(type, [&](auto kind) { return geometry_of<decltype(kind)>(nodes, shape); });
}

FaceGeometry face_geometry(CellType type, const FaceCoordinates& nodes, const Vector2d& xi) {
  const auto& cell = cell::reference_cell(type);
  return with_kind(type, [&](auto kind) { return FaceMap<decltype(kind)>(nodes, cell).at(xi); });
}

Vector3d outward_normal(CellType type, const FaceCoordinates& nodes, const Vector2d& xi) {
  constexpr double no_area = 1e-14; // in squared face sizes: rounding
  const auto at = face_geometry(type, nodes, xi);
  const Vector3d first = column_of(at.tangents, 0), second = column_of(at.tangents, 1);
  const Vector3d area = cross(first, second);
  const double size =
      cell::topology(type).dimension == 2 ? dot(first, first) + dot(second, second) : length_of(first);
  return length_of(area) > no_area * size ? unit_of(area) : Vector3d(0, 0, 0);
}

std::array<Vector3d, 9> surface_gradients(CellType type, const FaceCoordinates& nodes, const Vector2d& xi) {
  std::array<Vector3d, 9> gradients;
  gradients.fill(Vector3d::Zero());
  const auto shape = face_shape(type, xi);
  const auto at = face_geometry(type, nodes, shape);
  const Vector3d first = column_of(at.tangents, 0), second = column_of(at.tangents, 1);
  const double a = dot(first, first), b = dot(first, second), c = dot(second, second);
  const double determinant = a * c - b * b;
  if (!(determinant > 0))
    return gradients;
  const Vector3d dual_first = scaled(1 / determinant, difference_of(scaled(c, first), scaled(b, second)));
  const Vector3d dual_second = scaled(1 / determinant, difference_of(scaled(a, second), scaled(b, first)));
  const int dimension = cell::topology(type).dimension;
  for (Eigen::Index i = 0; i < nodes.cols(); ++i) {
    const auto slope = static_cast<std::size_t>(i * dimension);
    add_scaled(shape.gradients[slope], dual_first, gradients[static_cast<std::size_t>(i)]);
    if (dimension == 2)
      add_scaled(shape.gradients[slope + 1], dual_second, gradients[static_cast<std::size_t>(i)]);
  }
  return gradients;
}

Vector3d face_position(CellType type, const FaceCoordinates& nodes, const Vector2d& xi) {
  const auto& cell = cell::reference_cell(type);
  return with_kind(type, [&](auto kind) { return FaceMap<decltype(kind)>(nodes, cell).position(xi); });
}

std::array<double, 9> face_values(CellType type, const Vector2d& xi) {
  const auto& cell = cell::reference_cell(type);
  std::array<double, 9> values;
  cell.values({xi[0], xi[1], 0}, std::span(values).first(static_cast<std::size_t>(cell.node_count)));
  return values;
}

void clamp_to_face(CellType type, Projection& projection) {
  with_kind(type, [&](auto kind) { clamp<decltype(kind)>(projection); });
}

Projection project(CellType type, const FaceCoordinates& nodes, const Vector3d& point, Wanted wanted) {
  Projection result;
  const auto& cell = cell::reference_cell(type);
  with_kind(type, [&](auto kind) {
    using Kind = decltype(kind);
    if constexpr (Kind::triangle)
      result.xi = Vector2d(1.0 / 3, 1.0 / 3);
    iterate<Kind>(nodes, point, wanted, cell, result);
    clamp<Kind>(result);
  });
  return result;
}

} // namespace rubato::contact
