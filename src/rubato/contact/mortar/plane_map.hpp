// SPDX-License-Identifier: LGPL-3.0-or-later
/// From points of an auxiliary plane back to the reference coordinates of a curved face.
#pragma once

#include "rubato/contact/mortar/face_polynomial.hpp"
#include "rubato/contact/projection.hpp"

#include <Eigen/Core>

#include <array>

namespace rubato::contact::mortar {

/// A place on a face above or below a point of the plane.
struct PlanePlace {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  std::array<double, 9> values; ///< N(ξ) of the face's nodes
  double height = 0;            ///< above the plane [length]
  double determinant = 0;       ///< of ∂p/∂ξ [length²]
  bool found = false;           ///< whether Newton's method came to an end near the face
};

/// p = Σ N_k(ξ) p_k of a face seen along the normal of a plane.
class PlaneMap {
public:
  PlaneMap() = default;
  /// `local`: the nodes in axes whose third is the plane's normal.
  PlaneMap(CellType type, const FaceCoordinates& local);

  CellType type() const { return type_; }
  const FaceCoordinates& local() const { return local_; }

  /// ξ with p(ξ) = p, by Newton's method from `start`. Where it fails or ends more than half a face outside,
  /// `found` is false and the rest says nothing.
  PlanePlace place_of(const Eigen::Vector2d& p, const Eigen::Vector2d& start) const;

  /// The place at given reference coordinates.
  PlanePlace place_at(const Eigen::Vector2d& xi) const;

private:
  CellType type_ = CellType::quad4;
  FaceCoordinates local_;
  FacePolynomial polynomial_;
  double size_ = 0; ///< of the face [length]
};

} // namespace rubato::contact::mortar
