// SPDX-License-Identifier: LGPL-3.0-or-later
/// Arithmetic of vectors in space without expression templates: each expression of Eigen is compiled anew
/// wherever it is written, these functions are compiled once.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace rubato::contact {

inline double dot(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a[0] * b[0] + a[1] * b[1];
}

inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double dot(const Eigen::Vector4d& a, const Eigen::Vector4d& b) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}

inline double total_of(const Eigen::Vector4d& a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

inline Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Eigen::Vector2d scaled(double factor, const Eigen::Vector2d& a) {
  return {factor * a[0], factor * a[1]};
}

inline Eigen::Vector3d scaled(double factor, const Eigen::Vector3d& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

inline Eigen::Vector3d sum_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// a − b
inline Eigen::Vector3d difference_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Eigen::Vector2d difference_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

/// to += factor · a
inline void add_scaled(double factor, const Eigen::Vector3d& a, Eigen::Vector3d& to) {
  for (int i = 0; i < 3; ++i)
    to[i] += factor * a[i];
}

inline double length_of(const Eigen::Vector2d& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1]);
}

inline double length_of(const Eigen::Vector3d& a) {
  return std::sqrt(dot(a, a));
}

inline bool is_finite(const Eigen::Vector3d& a) {
  return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

inline bool is_zero(const Eigen::Vector3d& a) {
  return a[0] == 0 && a[1] == 0 && a[2] == 0;
}

/// a / |a|; 0 where a is 0.
inline Eigen::Vector3d unit_of(const Eigen::Vector3d& a) {
  const double length = length_of(a);
  return length > 0 ? Eigen::Vector3d(a[0] / length, a[1] / length, a[2] / length) : a;
}

/// A unit vector perpendicular to a.
inline Eigen::Vector3d unit_across(const Eigen::Vector3d& a) {
  constexpr double rounding = 1e-12;
  const auto is_rounding = [&](double part) { return std::abs(part) <= rounding * std::abs(a[2]); };
  if (!is_rounding(a[0]) || !is_rounding(a[1])) {
    const double inverse = 1 / std::sqrt(a[0] * a[0] + a[1] * a[1]);
    return {-a[1] * inverse, a[0] * inverse, 0};
  }
  const double inverse = 1 / std::sqrt(a[1] * a[1] + a[2] * a[2]);
  return {0, -a[2] * inverse, a[1] * inverse};
}

/// The part of a across a unit vector.
inline Eigen::Vector3d part_across(const Eigen::Vector3d& unit, const Eigen::Vector3d& a) {
  return difference_of(a, scaled(dot(a, unit), unit));
}

/// A column of three rows, such as a tangent or the place of a node.
template <class Matrix> Eigen::Vector3d column_of(const Matrix& matrix, Eigen::Index column) {
  return {matrix(0, column), matrix(1, column), matrix(2, column)};
}

template <class Matrix> void set_column(Eigen::Index column, const Eigen::Vector3d& from, Matrix& matrix) {
  for (int i = 0; i < 3; ++i)
    matrix(i, column) = from[i];
}

} // namespace rubato::contact
