// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/projection.hpp"

#include "rubato/fem/reference_cell.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::contact {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Projections this near to the border lie on it but for rounding.
constexpr double snap = 1e-12;
constexpr int max_iterations = 30;
/// Beyond this many face sizes the quadratic shape functions say nothing about the face any more.
constexpr double far_away = 8.0;

bool is_triangle(mesh::CellType type) {
  return mesh::topology(type).corner_count == 3;
}

void finish(Projection& p) {
  p.overshoot = (p.xi - p.clamped).norm();
  if (p.overshoot > snap)
    return;
  p.overshoot = 0;
  p.clamped = p.xi;
  p.clamp_derivative.setIdentity();
}

void clamp_to_box(int dimension, Projection& p) {
  for (int a = 0; a < dimension; ++a) {
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

/// One Newton step for the stationary distance; the Gauss–Newton matrix stands in where curvature spoils the
/// minimum.
Vector2d newton_step(const FaceGeometry& at, const Vector3d& point, int dimension) {
  const Vector3d distance = point - at.position;
  if (dimension == 1) {
    const double metric = at.tangents.col(0).squaredNorm();
    const double exact = metric - distance.dot(at.curvatures[0][0]);
    const double slope = exact > 0.1 * metric ? exact : metric;
    return {distance.dot(at.tangents.col(0)) / slope, 0.0};
  }
  const Matrix2d metric = at.tangents.transpose() * at.tangents;
  Matrix2d exact = metric;
  for (int a = 0; a < 2; ++a)
    for (int b = 0; b < 2; ++b)
      exact(a, b) -= distance.dot(at.curvatures[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]);
  const bool minimum = exact.determinant() > 0.01 * metric.determinant() && exact(0, 0) > 0;
  const Vector2d slope = at.tangents.transpose() * distance;
  return (minimum ? exact : metric).inverse() * slope;
}

} // namespace

FaceGeometry face_geometry(mesh::CellType type, const FaceCoordinates& nodes, const Vector2d& xi) {
  const auto& cell = fem::reference_cell(type);
  const int n = cell.node_count;
  const int dimension = cell.dimension;
  std::array<double, 9> values{};
  std::array<double, 18> gradients{};
  std::array<double, 36> hessians{};
  const Vector3d xi3(xi[0], xi[1], 0);
  cell.values(xi3, std::span(values).first(static_cast<std::size_t>(n)));
  cell.gradients(xi3, std::span(gradients).first(static_cast<std::size_t>(n * dimension)));
  cell.hessians(xi3, std::span(hessians).first(static_cast<std::size_t>(n * dimension * dimension)));

  FaceGeometry geometry;
  for (auto& row : geometry.curvatures)
    for (auto& entry : row)
      entry.setZero();
  if (dimension == 1)
    geometry.tangents.col(1) = Vector3d::UnitZ();
  for (int i = 0; i < n; ++i) {
    const Vector3d x = nodes.col(i);
    geometry.position += values[static_cast<std::size_t>(i)] * x;
    for (int a = 0; a < dimension; ++a) {
      geometry.tangents.col(a) += gradients[static_cast<std::size_t>(i * dimension + a)] * x;
      for (int b = 0; b < dimension; ++b)
        geometry.curvatures[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] +=
            hessians[static_cast<std::size_t>((i * dimension + a) * dimension + b)] * x;
    }
  }
  return geometry;
}

void clamp_to_face(mesh::CellType type, Projection& projection) {
  projection.clamped = projection.xi;
  projection.clamp_derivative.setIdentity();
  if (is_triangle(type))
    clamp_to_triangle(projection);
  else
    clamp_to_box(mesh::topology(type).dimension, projection);
  finish(projection);
}

Projection project(mesh::CellType type, const FaceCoordinates& nodes, const Vector3d& point) {
  const int dimension = mesh::topology(type).dimension;
  Projection result;
  if (is_triangle(type))
    result.xi = Vector2d(1.0 / 3, 1.0 / 3);
  for (int iteration = 0; iteration < max_iterations && !result.converged; ++iteration) {
    const auto at = face_geometry(type, nodes, result.xi);
    const Vector2d step = newton_step(at, point, dimension);
    if (!step.allFinite())
      break;
    result.xi += step;
    if (result.xi.norm() > far_away)
      result.xi *= far_away / result.xi.norm();
    result.converged = step.norm() <= 1e-14 * std::max(1.0, result.xi.norm());
    // Rounding keeps the last digit moving on long faces; a step of a few of them changes nothing any more.
    if (iteration > 6 && step.norm() <= 1e-11)
      result.converged = true;
  }
  clamp_to_face(type, result);
  return result;
}

} // namespace rubato::contact
