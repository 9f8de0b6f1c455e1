// SPDX-License-Identifier: LGPL-3.0-or-later
/// Symmetric tensors as six numbers xx yy zz xy yz xz: of stresses as they are, of strains with doubled
/// shears.
#pragma once

#include "rubato/material/point_response.hpp"

namespace rubato::material {

/// a:b of two tensors with shears as they are, which stresses are.
inline double double_dot(const Stress6& a, const Stress6& b) {
  return a.head<3>().dot(b.head<3>()) + 2 * a.tail<3>().dot(b.tail<3>());
}

/// a:b of two strains.
inline double strain_double_dot(const Strain6& a, const Strain6& b) {
  return a.head<3>().dot(b.head<3>()) + 0.5 * a.tail<3>().dot(b.tail<3>());
}

inline double trace(const Strain6& a) {
  return a[0] + a[1] + a[2];
}

/// Of strains and of stresses.
inline Strain6 deviator(const Strain6& a) {
  Strain6 dev = a;
  dev.head<3>().array() -= trace(a) / 3;
  return dev;
}

/// A strain's tensor with shears as they are.
inline Stress6 halved_shears(Strain6 a) {
  a.tail<3>() *= 0.5;
  return a;
}

inline Strain6 doubled_shears(Stress6 a) {
  a.tail<3>() *= 2;
  return a;
}

/// K 1⊗1 + `twice_shear` I_dev, that takes strains to stresses.
inline void set_isotropic(Tangent6& d, double bulk, double twice_shear) {
  d.setZero();
  d.topLeftCorner<3, 3>().setConstant(bulk - twice_shear / 3);
  d.diagonal().head<3>().array() += twice_shear;
  d.diagonal().tail<3>().setConstant(0.5 * twice_shear);
}

/// Six numbers of a state.
inline Eigen::Map<const Strain6> six_at(std::span<const double> state, std::size_t from) {
  return Eigen::Map<const Strain6>(state.data() + from);
}
inline Eigen::Map<Strain6> six_at(std::span<double> state, std::size_t from) {
  return Eigen::Map<Strain6>(state.data() + from);
}

} // namespace rubato::material
