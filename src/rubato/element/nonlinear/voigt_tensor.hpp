// SPDX-License-Identifier: LGPL-3.0-or-later
/// Symmetric tensors of a point and their Voigt vectors, xx yy zz xy yz xz.
#pragma once

#include "rubato/material/point_response.hpp"

#include <Eigen/Core>

namespace rubato::element {

/// Place of component ij of a symmetric tensor in Voigt's order xx yy zz xy yz xz.
constexpr int voigt_place(int i, int j) {
  constexpr int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  return place[i][j];
}

/// The tensor of a stress.
inline Eigen::Matrix3d tensor_of(const material::Stress6& s) {
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return tensor;
}

/// The Voigt vector of a stress.
inline material::Stress6 stress_of(const Eigen::Matrix3d& tensor) {
  material::Stress6 stress;
  stress << tensor(0, 0), tensor(1, 1), tensor(2, 2), tensor(0, 1), tensor(1, 2), tensor(0, 2);
  return stress;
}

/// The Voigt vector, with engineering shears, of half a tensor.
inline material::Strain6 half_strain_of(const Eigen::Matrix3d& doubled) {
  material::Strain6 strain = stress_of(doubled);
  strain.head<3>() /= 2;
  return strain;
}

} // namespace rubato::element
