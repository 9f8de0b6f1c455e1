// SPDX-License-Identifier: LGPL-3.0-or-later
/// A face as a polynomial in its reference coordinates: faster than shape functions where many places of one
/// face are looked at.
#pragma once

#include "rubato/contact/projection.hpp"

#include <Eigen/Core>

namespace rubato::contact::mortar {

/// x(ξ) = Σ c_ab ξ^a η^b, a, b ≤ 2, of triangles and quadrangles: the shape functions of all of them are
/// among these products.
class FacePolynomial {
  auto factor(int a, int b) const { return factors_.col(a + 3 * b); }

public:
  struct Place {
    Eigen::Vector3d position, by_first, by_second;
  };

  FacePolynomial() = default;
  FacePolynomial(CellType type, const FaceCoordinates& nodes);

  Place at(const Eigen::Vector2d& xi) const {
    const double s = xi[0], t = xi[1];
    if (bilinear_) {
      const Eigen::Vector3d by_first = factor(1, 0) + t * factor(1, 1);
      return {factor(0, 0) + s * by_first + t * factor(0, 1), by_first, factor(0, 1) + s * factor(1, 1)};
    }
    const auto along = [&](int b) -> Eigen::Vector3d {
      return factor(0, b) + s * (factor(1, b) + s * factor(2, b));
    };
    const auto slope = [&](int b) -> Eigen::Vector3d { return factor(1, b) + 2 * s * factor(2, b); };
    const Eigen::Vector3d constant = along(0), linear = along(1), square = along(2);
    return {constant + t * (linear + t * square), slope(0) + t * (slope(1) + t * slope(2)),
            linear + 2 * t * square};
  }

private:
  Eigen::Matrix<double, 3, 9> factors_ = Eigen::Matrix<double, 3, 9>::Zero(); ///< c_ab in column a + 3b
  bool bilinear_ = true;                                                      ///< a, b ≤ 1 only
};

} // namespace rubato::contact::mortar
