// SPDX-License-Identifier: LGPL-3.0-or-later
/// From points of an auxiliary plane back to the reference coordinates of a curved face.
#pragma once

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/face_polynomial.hpp"
#include "rubato/contact/projection.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace rubato::contact::mortar {

/// A place on a face above or below a point of the plane.
struct PlanePlace {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  double height = 0;      ///< above the plane [length]
  double determinant = 0; ///< of ∂p/∂ξ [length²]
  bool found = false;     ///< whether Newton's method came to an end near the face
};

/// Points of the plane and their places on a face, each number by itself: many are found as fast as a few
/// one after the other. `p` and starting points in `xi` are given, the rest is found. Entries from `count`
/// on are not set.
struct PlanePlaces {
  /// Corners of the largest polygon and their mean; points of the largest rule of a triangle.
  static constexpr std::size_t capacity = 20;
  using Numbers = std::array<double, capacity>;

  explicit PlanePlaces(std::size_t count_of_points) : count(count_of_points) {}
  void start(std::size_t i, const Eigen::Vector2d& point, const Eigen::Vector2d& at) {
    p[0][i] = point[0];
    p[1][i] = point[1];
    xi[0][i] = at[0];
    xi[1][i] = at[1];
  }
  Eigen::Vector2d point_at(std::size_t i) const { return {p[0][i], p[1][i]}; }
  Eigen::Vector2d xi_at(std::size_t i) const { return {xi[0][i], xi[1][i]}; }
  /// Takes over a place that was found otherwise.
  void set(std::size_t i, const PlanePlace& place) {
    xi[0][i] = place.xi[0];
    xi[1][i] = place.xi[1];
    height[i] = place.height;
    determinant[i] = place.determinant;
    found[i] = place.found ? 1 : 0;
  }

  std::size_t count;
  std::array<Numbers, 2> p, xi;
  Numbers height, determinant;
  Numbers found; ///< 1 or 0
};

/// p = Σ N_k(ξ) p_k of a face seen along the normal of a plane.
class PlaneMap {
public:
  PlaneMap() = default;
  /// `local`: the nodes in axes whose third is the plane's normal.
  PlaneMap(CellType type, const FaceCoordinates& local);

  CellType type() const { return type_; }
  const FaceCoordinates& local() const { return local_; }

  /// ξ with p(ξ) = p of all points, by Newton's method from their starting points. Where it fails or ends
  /// more than half a face outside, `found` is false and the rest says nothing.
  void find(PlanePlaces& places) const;

  /// The place at given reference coordinates.
  PlanePlace place_at(const Eigen::Vector2d& xi) const;

  /// N(ξ) of the face's nodes.
  void set_values(const Eigen::Vector2d& xi, std::array<double, 9>& values) const;

private:
  template <FaceTerms terms> void iterate(PlanePlaces& places) const;

  CellType type_ = CellType::quad4;
  const cell::ReferenceCell* cell_ = nullptr;
  FaceCoordinates local_;
  FacePolynomial polynomial_;
  double size_ = 0; ///< of the face [length]
};

} // namespace rubato::contact::mortar
