// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include <random>

namespace rubato::test {

/// Between −1 and 1, always the same of one seed.
inline Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return value(random); });
}

} // namespace rubato::test
