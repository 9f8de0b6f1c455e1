// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/tresca_problem.hpp"

#include "rubato/linalg/dense_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
/// Along the slips of a point.
using Tangential = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;

constexpr int most_friction_sweeps = 50;
/// Change in a sweep, in parts of the largest limit, that a prediction needs no better than.
constexpr double good_friction = 1e-2;
constexpr int most_stick_sets = 30;

/// From what the sweeps have found; keeps that when the set doesn't settle.
void tresca_active_set(const MatrixXd& matrix, const VectorXd& slips, const VectorXd& limits,
                       VectorXd& settled, Progress& progress) {
  VectorXd forces = settled;
  VectorXd moved = slips;
  moved.noalias() += matrix * forces;
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
    held.noalias() += matrix * next;
    const VectorXd pulled_back = linalg::solve_among(sticking, matrix, held);
    if (!pulled_back.allFinite()) // points that say the same
      return;
    for (std::size_t k = 0; k < sticking.size(); ++k)
      next[sticking[k]] = pulled_back[static_cast<Index>(k)];
    const bool same = (next - forces).lpNorm<Eigen::Infinity>() <= 1e-9 * limits.maxCoeff();
    forces = next;
    moved = slips;
    moved.noalias() += matrix * forces;
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
  slips.noalias() += matrix * forces;
  for (int round = 0; round < most_friction_sweeps; ++round) {
    double largest_change = 0;
    for (Index i = 0; i < limits.size(); ++i) {
      const Index first = i * tangents;
      const double stiffest = matrix.diagonal().segment(first, tangents).maxCoeff();
      if (stiffest <= 0)
        continue;
      Tangential wanted = forces.segment(first, tangents) - slips.segment(first, tangents) / stiffest;
      if (const double length = wanted.norm(); length > limits[i])
        wanted *= limits[i] / length;
      const Tangential change = wanted - forces.segment(first, tangents);
      largest_change = std::max(largest_change, change.lpNorm<Eigen::Infinity>());
      forces.segment(first, tangents) = wanted;
      for (Index a = 0; a < tangents; ++a)
        slips += change[a] * matrix.col(first + a);
    }
    if (largest_change <= good_friction * limits.maxCoeff())
      return;
  }
}

} // namespace rubato::step
