// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the folder only: derivatives by the few motions of a contact point (kinematics.hpp). A row has
/// factors of each motion's components.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>

namespace rubato::contact {

template <int Dimension> struct MotionRows {
  static constexpr int components = Dimension + 1;
  static constexpr int place_motions = 1 + Dimension; ///< e, m_a
  /// The components of each motion, and a zero where their number is odd: compilers make vector instructions
  /// of loops over even numbers.
  static constexpr std::size_t width = Dimension == 2 ? 4 : 2;
  using Motion = std::array<double, width>;
  using Row = std::array<Motion, 2 * place_motions + 1>;

  /// The first `count` motions become 0.
  static void clear(int count, Row& row) {
    for (int m = 0; m < count; ++m)
      row[static_cast<std::size_t>(m)].fill(0);
  }
  static void add(int count, double factor, const Row& row, Row& to) {
    for (std::size_t m = 0; m < static_cast<std::size_t>(count); ++m)
      add(factor, row[m], to[m]);
  }
  static void assign(int count, double factor, const Row& from, Row& to) {
    for (std::size_t m = 0; m < static_cast<std::size_t>(count); ++m)
      for (std::size_t c = 0; c < width; ++c)
        to[m][c] = factor * from[m][c];
  }
  static void add(double factor, const Eigen::Vector3d& v, Motion& to) {
    for (std::size_t c = 0; c < components; ++c)
      to[c] += factor * v[static_cast<Eigen::Index>(c)];
  }
  static void add(double factor, const Motion& motion, Motion& to) {
    for (std::size_t c = 0; c < width; ++c)
      to[c] += factor * motion[c];
  }
};

} // namespace rubato::contact
