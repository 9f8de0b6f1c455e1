// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/lanczos.hpp"

#include "rubato/linalg/dense_decompositions.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double relative_error = 0.01;
constexpr double failures = 1e-12; ///< part of all random starts that would give less than promised

/// The smallest k with 1.648 √n exp(−√ε (2k − 1)) ≤ failures.
Index steps_for(Index size) {
  const double needed = std::log(1.648 * std::sqrt(static_cast<double>(size)) / failures);
  const auto steps = static_cast<Index>(std::ceil((needed / std::sqrt(relative_error) + 1) / 2));
  return std::min(steps, size);
}

VectorXd random_direction(const VectorXd& diagonal) {
  std::mt19937_64 generator(1992);
  std::normal_distribution<double> normal;
  VectorXd start(diagonal.size());
  for (Index i = 0; i < start.size(); ++i)
    start[i] = diagonal[i] > 0 ? normal(generator) : 0.0;
  const double length = start.norm();
  return length > 0 ? VectorXd(start / length) : start;
}

} // namespace

double largest_eigenvalue(const SymmetricBlockMatrix& matrix, const VectorXd& diagonal) {
  return largest_eigenvalue([&](const VectorXd& x, VectorXd& y) { matrix.multiply(x, y); }, diagonal);
}

double largest_eigenvalue(const Product& multiply, const VectorXd& diagonal) {
  const VectorXd root = diagonal.cwiseSqrt();
  const Index most = steps_for(diagonal.size());
  VectorXd now = random_direction(diagonal);
  VectorXd before = VectorXd::Zero(now.size());
  VectorXd scaled(now.size());
  VectorXd next(now.size());
  VectorXd alpha(most);
  VectorXd beta(most);
  Index steps = 0;
  double coupling = 0;
  double scale = 0;
  while (steps < most) {
    scaled = root.cwiseProduct(now);
    multiply(scaled, next);
    next.array() *= root.array();
    alpha[steps] = next.dot(now);
    next -= alpha[steps] * now + coupling * before;
    coupling = next.norm();
    beta[steps] = coupling;
    scale = std::max(scale, std::abs(alpha[steps]) + coupling);
    ++steps;
    if (!(coupling > 1e-14 * scale)) // the start lies in a space that the matrix maps on itself
      break;
    before.swap(now);
    now = next / coupling;
  }
  if (!(scale > 0))
    return 0;
  alpha.conservativeResize(steps);
  const double largest = largest_of_tridiagonal(alpha, beta);
  if (!std::isfinite(largest))
    throw std::runtime_error("the largest eigenvalue of the explicit steps' matrix was not found");
  return largest / (1 - relative_error);
}

} // namespace rubato::linalg
