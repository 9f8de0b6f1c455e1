// SPDX-License-Identifier: LGPL-3.0-or-later
/// A face as a polynomial in its reference coordinates: faster than shape functions where many places of one
/// face are looked at.
#pragma once

#include "rubato/contact/projection.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace rubato::contact::mortar {

/// Which of the products ξ^a η^b a face has: bilinear a, b ≤ 1; quadratic a + b ≤ 2; serendipity all but
/// ξ²η²; biquadratic all.
enum class FaceTerms : std::uint8_t { bilinear, quadratic, serendipity, biquadratic };

/// One coordinate of a place on a face with its derivatives by ξ and η.
struct FaceCoordinate {
  double value, by_first, by_second;
};

/// x(ξ) = Σ c_ab ξ^a η^b, a, b ≤ 2, of triangles and quadrangles: the shape functions of all of them are
/// among these products.
class FacePolynomial {
  double factor(int row, int a, int b) const { return factors_(row, a + 3 * b); }

public:
  struct Place {
    Eigen::Vector3d position, by_first, by_second;
  };

  FacePolynomial() = default;
  FacePolynomial(CellType type, const FaceCoordinates& nodes);

  FaceTerms terms() const { return terms_; }

  /// Coordinate `row` at (s, t). `terms` must be those of the face.
  template <FaceTerms terms> FaceCoordinate coordinate(int row, double s, double t) const {
    const double c00 = factor(row, 0, 0), c10 = factor(row, 1, 0);
    const double c01 = factor(row, 0, 1), c11 = factor(row, 1, 1);
    if constexpr (terms == FaceTerms::bilinear) {
      const double by_first = c10 + t * c11;
      return {c00 + s * by_first + t * c01, by_first, c01 + s * c11};
    } else {
      const double c20 = factor(row, 2, 0), c02 = factor(row, 0, 2);
      const double constant = c00 + s * (c10 + s * c20);
      double linear = c01 + s * c11, slope = c11, square = c02, bend = 0;
      if constexpr (terms != FaceTerms::quadratic) {
        const double c21 = factor(row, 2, 1), c12 = factor(row, 1, 2);
        const double c22 = terms == FaceTerms::biquadratic ? factor(row, 2, 2) : 0;
        linear = c01 + s * (c11 + s * c21);
        slope = c11 + 2 * s * c21;
        square = terms == FaceTerms::biquadratic ? c02 + s * (c12 + s * c22) : c02 + s * c12;
        bend = terms == FaceTerms::biquadratic ? c12 + 2 * s * c22 : c12;
      }
      const double twist = terms == FaceTerms::quadratic ? slope : slope + t * bend;
      return {constant + t * (linear + t * square), c10 + 2 * s * c20 + t * twist, linear + 2 * t * square};
    }
  }

  /// visit.operator()<terms>() with those of this face: to choose once for many places.
  template <class Visit> auto with_terms(const Visit& visit) const {
    switch (terms_) {
    case FaceTerms::bilinear:
      return visit.template operator()<FaceTerms::bilinear>();
    case FaceTerms::quadratic:
      return visit.template operator()<FaceTerms::quadratic>();
    case FaceTerms::serendipity:
      return visit.template operator()<FaceTerms::serendipity>();
    default:
      return visit.template operator()<FaceTerms::biquadratic>();
    }
  }

  Place at(const Eigen::Vector2d& xi) const {
    return with_terms([&]<FaceTerms terms>() {
      Place place;
      for (int row = 0; row < 3; ++row) {
        const auto found = coordinate<terms>(row, xi[0], xi[1]);
        place.position[row] = found.value;
        place.by_first[row] = found.by_first;
        place.by_second[row] = found.by_second;
      }
      return place;
    });
  }

private:
  Eigen::Matrix<double, 3, 9> factors_ = Eigen::Matrix<double, 3, 9>::Zero(); ///< c_ab in column a + 3b
  FaceTerms terms_ = FaceTerms::bilinear;
};

} // namespace rubato::contact::mortar
