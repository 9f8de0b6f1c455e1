// SPDX-License-Identifier: LGPL-3.0-or-later
/// Symmetric tensors as six numbers xx yy zz xy yz xz: of stresses as they are, of strains with doubled
/// shears.
///
/// All work on six numbers at once: parts of vectors, written one by one and read as a whole, cost more than
/// the arithmetic.
#pragma once

#include "rubato/material/point_response.hpp"

#include <array>

namespace rubato::material {

inline constexpr std::array<double, 6> six_of_one{1, 1, 1, 0, 0, 0};
inline constexpr std::array<double, 6> six_with_half_shears{1, 1, 1, 0.5, 0.5, 0.5};
inline constexpr std::array<double, 6> six_with_twice_shears{1, 1, 1, 2, 2, 2};

inline Eigen::Map<const Strain6> six_of(const std::array<double, 6>& numbers) {
  return Eigen::Map<const Strain6>(numbers.data());
}

/// a:b of two tensors with shears as they are, which stresses are.
inline double double_dot(const Stress6& a, const Stress6& b) {
  return a.cwiseProduct(b).dot(six_of(six_with_twice_shears));
}

/// a:b of two strains.
inline double strain_double_dot(const Strain6& a, const Strain6& b) {
  return a.cwiseProduct(b).dot(six_of(six_with_half_shears));
}

inline double trace(const Strain6& a) {
  return a[0] + a[1] + a[2];
}

/// Of strains and of stresses.
inline Strain6 deviator(const Strain6& a) {
  return a - trace(a) / 3 * six_of(six_of_one);
}

/// A strain's tensor with shears as they are.
inline Stress6 halved_shears(const Strain6& a) {
  return a.cwiseProduct(six_of(six_with_half_shears));
}

inline Strain6 doubled_shears(const Stress6& a) {
  return a.cwiseProduct(six_of(six_with_twice_shears));
}

/// K 1⊗1 + `twice_shear` I_dev, that takes strains to stresses.
inline void set_isotropic(Tangent6& d, double bulk, double twice_shear) {
  d.setZero();
  d.topLeftCorner<3, 3>().setConstant(bulk - twice_shear / 3);
  d.diagonal() += twice_shear * six_of(six_with_half_shears);
}

/// Six numbers of a state.
inline Eigen::Map<const Strain6> six_at(std::span<const double> state, std::size_t from) {
  return Eigen::Map<const Strain6>(state.data() + from);
}
inline Eigen::Map<Strain6> six_at(std::span<double> state, std::size_t from) {
  return Eigen::Map<Strain6>(state.data() + from);
}

} // namespace rubato::material
