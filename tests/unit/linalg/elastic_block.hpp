// SPDX-License-Identifier: LGPL-3.0-or-later
/// Systems with the pattern and the numbers of real studies: a block of unit cubes of linear elasticity.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <vector>

namespace rubato::test {

/// Stiffness of a unit cube with eight nodes (node 1·i + 2·j + 4·k at corner (i, j, k)), Poisson's ratio 0.3.
inline Eigen::Matrix<double, 24, 24> cube_stiffness(double young) {
  constexpr double poisson = 0.3;
  const double shear = young / (2 * (1 + poisson));
  const double lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
  Eigen::Matrix<double, 6, 6> law = Eigen::Matrix<double, 6, 6>::Zero();
  law.topLeftCorner<3, 3>().setConstant(lame);
  law.diagonal() << lame + 2 * shear, lame + 2 * shear, lame + 2 * shear, shear, shear, shear;

  Eigen::Matrix<double, 24, 24> stiffness = Eigen::Matrix<double, 24, 24>::Zero();
  const double low = 0.5 - 0.5 / std::sqrt(3.0);
  for (int point = 0; point < 8; ++point) {
    const std::array<double, 3> at{(point & 1) ? 1 - low : low, (point & 2) ? 1 - low : low,
                                   (point & 4) ? 1 - low : low};
    Eigen::Matrix<double, 6, 24> strain = Eigen::Matrix<double, 6, 24>::Zero();
    for (int node = 0; node < 8; ++node) {
      std::array<double, 3> value{};
      std::array<double, 3> slope{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool high = (node >> axis) & 1;
        value[axis] = high ? at[axis] : 1 - at[axis];
        slope[axis] = high ? 1 : -1;
      }
      const double dx = slope[0] * value[1] * value[2];
      const double dy = value[0] * slope[1] * value[2];
      const double dz = value[0] * value[1] * slope[2];
      strain.block<6, 3>(0, 3 * node) << dx, 0, 0, 0, dy, 0, 0, 0, dz, dy, dx, 0, 0, dz, dy, dz, 0, dx;
    }
    stiffness += 0.125 * strain.transpose() * law * strain;
  }
  return stiffness;
}

/// nx × ny × nz cubes. With `clamped`, the face x = 0 is fixed and its unknowns are absent; else the block
/// floats and its stiffness has six rigid motions.
inline linalg::SparseMatrix elastic_block(int nx, int ny, int nz, bool clamped = true, double young = 200e9) {
  const auto element = cube_stiffness(young);
  const int first = clamped ? 1 : 0;
  const int plane = (ny + 1) * (nz + 1);
  const auto node_at = [&](int i, int j, int k) { return (i - first) * plane + j * (nz + 1) + k; };
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(nx * ny * nz) * 576);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k)
        for (int a = 0; a < 24; ++a)
          for (int b = 0; b < 24; ++b) {
            const int node_a = node_at(i + (a / 3 & 1), j + (a / 3 >> 1 & 1), k + (a / 3 >> 2));
            const int node_b = node_at(i + (b / 3 & 1), j + (b / 3 >> 1 & 1), k + (b / 3 >> 2));
            if (node_a >= 0 && node_b >= 0)
              entries.emplace_back(3 * node_a + a % 3, 3 * node_b + b % 3, element(a, b));
          }
  const int size = 3 * (nx + 1 - first) * plane;
  linalg::SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// [K Bᵀ; B 0]: the block whose last `tie_count` nodes are tied, component by component, to nodes `stride`
/// before them. As in a mixed contact system, the constraints are of order one beside stiffnesses of 1e11.
inline linalg::SparseMatrix tied_block(const linalg::SparseMatrix& stiffness, int tie_count, int stride) {
  const auto n = static_cast<int>(stiffness.cols());
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < n; ++column)
    for (linalg::SparseMatrix::InnerIterator entry(stiffness, column); entry; ++entry)
      entries.emplace_back(static_cast<int>(entry.row()), column, entry.value());
  for (int tie = 0; tie < 3 * tie_count; ++tie)
    for (const auto& [unknown, sign] :
         {std::pair{n - 1 - tie, 1.0}, std::pair{n - 1 - tie - 3 * stride, -1.0}}) {
      entries.emplace_back(n + tie, unknown, sign);
      entries.emplace_back(unknown, n + tie, sign);
    }
  linalg::SparseMatrix matrix(n + 3 * tie_count, n + 3 * tie_count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

} // namespace rubato::test
