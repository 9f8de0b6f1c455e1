// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/tresca_problem.hpp"

#include "rubato/linalg/dense_cholesky.hpp"
#include "rubato/linalg/dense_products.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_friction_sweeps = 50;
/// Change in a sweep, in parts of the largest limit, that a prediction needs no better than.
constexpr double good_friction = 1e-2;
constexpr int most_stick_sets = 30;

double largest_value(const VectorXd& values) {
  double largest = -std::numeric_limits<double>::infinity();
  for (const double value : values)
    largest = std::max(largest, value);
  return largest;
}

/// From what the sweeps have found; keeps that when the set doesn't settle.
void tresca_active_set(const MatrixXd& matrix, const VectorXd& slips, const VectorXd& limits,
                       VectorXd& settled, Progress& progress) {
  VectorXd forces = settled;
  VectorXd moved = slips;
  linalg::add_product(matrix, forces, moved);
  VectorXd next, held;
  std::vector<Index> sticking;
  sticking.reserve(static_cast<std::size_t>(forces.size()));
  for (int round = 0; round < most_stick_sets && progress.report(); ++round) {
    sticking.clear();
    next.setZero(forces.size()); // at the bounds first
    for (Index k = 0; k < forces.size(); ++k) {
      const double pulled = forces[k] - moved[k] / std::max(matrix(k, k), 1e-300);
      if (matrix(k, k) > 0 && std::abs(pulled) < limits[k])
        sticking.push_back(k);
      else
        next[k] = std::copysign(limits[k], pulled);
    }
    held = slips;
    linalg::add_product(matrix, next, held);
    const VectorXd pulled_back = linalg::solve_among(sticking, matrix, held);
    if (!pulled_back.allFinite()) // points that say the same
      return;
    for (std::size_t k = 0; k < sticking.size(); ++k)
      next[sticking[k]] = pulled_back[static_cast<Index>(k)];
    double change = 0;
    for (Index k = 0; k < forces.size(); ++k)
      change = std::max(change, std::abs(next[k] - forces[k]));
    const bool same = change <= 1e-9 * largest_value(limits);
    forces = next;
    moved = slips;
    linalg::add_product(matrix, forces, moved);
    if (same) {
      settled = forces;
      return;
    }
  }
}

} // namespace

void solve_tresca_problem(const MatrixXd& matrix, const VectorXd& values, const VectorXd& limits,
                          int tangents, VectorXd& forces, Progress& progress) {
  tresca_gauss_seidel(matrix, values, limits, tangents, forces);
  if (tangents == 1)
    tresca_active_set(matrix, values, limits, forces, progress);
}

void tresca_gauss_seidel(const MatrixXd& matrix, const VectorXd& values, const VectorXd& limits, int tangents,
                         VectorXd& forces) {
  VectorXd slips = values;
  linalg::add_product(matrix, forces, slips);
  for (int round = 0; round < most_friction_sweeps; ++round) {
    double largest_change = 0;
    for (Index i = 0; i < limits.size(); ++i) {
      const Index first = i * tangents;
      double stiffest = matrix(first, first);
      for (Index a = 1; a < tangents; ++a)
        stiffest = std::max(stiffest, matrix(first + a, first + a));
      if (stiffest <= 0)
        continue;
      std::array<double, 2> wanted{};
      double square = 0;
      for (Index a = 0; a < tangents; ++a) {
        const double value = forces[first + a] - slips[first + a] / stiffest;
        wanted[static_cast<std::size_t>(a)] = value;
        square += value * value;
      }
      const double length = std::sqrt(square);
      const double part = length > limits[i] ? limits[i] / length : 1;
      for (Index a = 0; a < tangents; ++a) {
        const double value = part * wanted[static_cast<std::size_t>(a)];
        const double change = value - forces[first + a];
        largest_change = std::max(largest_change, std::abs(change));
        forces[first + a] = value;
        slips += change * matrix.col(first + a);
      }
    }
    if (largest_change <= good_friction * largest_value(limits))
      return;
  }
}

} // namespace rubato::step
