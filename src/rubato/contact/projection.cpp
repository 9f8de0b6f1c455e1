// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/projection.hpp"

#include "rubato/cell/reference_cell.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace rubato::contact {
namespace {

using Eigen::Matrix2d;
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
  p.overshoot = (p.xi - p.clamped).norm();
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
    const Vector2d edge = corners[(i + 1) % 3] - corners[i];
    const double along = (p.xi - corners[i]).dot(edge) / edge.squaredNorm();
    const double kept = std::clamp(along, 0.0, 1.0);
    const Vector2d candidate = corners[i] + kept * edge;
    const double distance = (p.xi - candidate).norm();
    if (distance >= best)
      continue;
    best = distance;
    p.clamped = candidate;
    p.clamp_derivative =
        kept == along ? Matrix2d(edge * edge.transpose() / edge.squaredNorm()) : Matrix2d::Zero();
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

template <class Kind> FaceGeometry geometry_of(const FaceCoordinates& nodes, const FaceShape& shape) {
  constexpr int d = Kind::dimension;
  FaceGeometry at;
  at.position = weighted_sum<Kind::nodes, 1>(nodes, shape.values.data());
  at.tangents.col(1) = Vector3d::UnitZ();
  for (int a = 0; a < d; ++a)
    at.tangents.col(a) = weighted_sum<Kind::nodes, d>(nodes, shape.gradients.data() + a);
  for (auto& row : at.curvatures)
    row.fill(Vector3d::Zero());
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
      : a_(0.5 * (nodes.col(1) + nodes.col(0))), b_(0.5 * (nodes.col(1) - nodes.col(0))) {}
  FaceGeometry at(const Vector2d& xi) const {
    FaceGeometry geometry;
    geometry.position = position(xi);
    geometry.tangents << b_, Vector3d::UnitZ();
    for (auto& row : geometry.curvatures)
      row.fill(Vector3d::Zero());
    return geometry;
  }
  Vector3d position(const Vector2d& xi) const { return a_ + xi[0] * b_; }

private:
  Vector3d a_, b_;
};

/// x = a + ξ b + η c + ξη d
template <> class FaceMap<FaceKind<2, 4>> {
public:
  FaceMap(const FaceCoordinates& nodes, const cell::ReferenceCell& /*unused*/) {
    const Vector3d below = 0.25 * (nodes.col(0) + nodes.col(1)), above = 0.25 * (nodes.col(2) + nodes.col(3));
    const Vector3d along = 0.25 * (nodes.col(1) - nodes.col(0)), back = 0.25 * (nodes.col(2) - nodes.col(3));
    a_ = above + below;
    c_ = above - below;
    b_ = back + along;
    d_ = back - along;
  }
  FaceGeometry at(const Vector2d& xi) const {
    FaceGeometry geometry;
    geometry.tangents.col(0) = b_ + xi[1] * d_;
    geometry.tangents.col(1) = c_ + xi[0] * d_;
    geometry.position = position(xi);
    geometry.curvatures[0] = {Vector3d::Zero(), d_};
    geometry.curvatures[1] = {d_, Vector3d::Zero()};
    return geometry;
  }
  Vector3d position(const Vector2d& xi) const { return a_ + xi[0] * (b_ + xi[1] * d_) + xi[1] * c_; }

private:
  Vector3d a_, b_, c_, d_;
};

struct Step {
  Vector2d by;
  bool by_newton;
};

/// One Newton step for the stationary distance; the Gauss–Newton matrix stands in where curvature spoils the
/// minimum.
template <class Kind> Step next_step(const FaceGeometry& at, const Vector3d& point) {
  const Vector3d distance = point - at.position;
  if constexpr (Kind::dimension == 1) {
    const double metric = at.tangents.col(0).squaredNorm();
    const double exact = metric - distance.dot(at.curvatures[0][0]);
    const bool minimum = exact > 0.1 * metric;
    return {{distance.dot(at.tangents.col(0)) / (minimum ? exact : metric), 0.0}, minimum};
  } else {
    const Matrix2d metric = at.tangents.transpose() * at.tangents;
    Matrix2d exact = metric;
    for (int a = 0; a < 2; ++a)
      for (int b = 0; b < 2; ++b)
        exact(a, b) -= distance.dot(at.curvatures[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]);
    const bool minimum = exact.determinant() > 0.01 * metric.determinant() && exact(0, 0) > 0;
    const Vector2d slope = at.tangents.transpose() * distance;
    return {(minimum ? exact : metric).inverse() * slope, minimum};
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
  return xi.lpNorm<Eigen::Infinity>() - 1;
}

template <class Kind>
void iterate(const FaceCoordinates& nodes, const Vector3d& point, Wanted wanted,
             const cell::ReferenceCell& cell, Projection& result) {
  const FaceMap<Kind> face(nodes, cell);
  double before = 0;
  for (int iteration = 0; iteration < max_iterations && !result.converged; ++iteration) {
    const auto at = face.at(result.xi);
    const auto step = next_step<Kind>(at, point);
    if (!step.by.allFinite())
      break;
    result.xi += step.by;
    const double size = result.xi.norm();
    if (size > far_away)
      result.xi *= far_away / size;
    const double length = step.by.norm();
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
