// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/normal_problem.hpp"

#include "rubato/core/tolerances.hpp"
#include "rubato/linalg/dense_cholesky.hpp"
#include "rubato/linalg/dense_products.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_sweeps = 50;
/// Change in a sweep, in parts of the largest force, that a prediction needs no better than.
constexpr double good_enough = 1e-2;
constexpr int most_sets = 30;

/// Part of the largest value that rounding makes of zero.
constexpr double rounding = 1e-12;
/// Rounds that changes by one point at a time take at most, in unknowns.
constexpr Index most_changes = 3;

/// Gaps that conjugate gradients leave, in parts of the largest one without forces.
constexpr double gap_tolerance = 1e-13;
/// Products of the power method that bounds ‖matrix‖ from below; the step length leaves the rest as margin.
constexpr int norm_products = 12;
constexpr int iterations_per_unknown = 20;
constexpr int least_iterations = 500;

bool is_nowhere_negative(const VectorXd& values) {
  return std::ranges::all_of(values, [](double value) { return value >= 0; });
}

/// Primal-dual active set from what the sweeps have found; keeps that when the set doesn't settle. Whether it
/// does.
bool normal_active_set(const MatrixXd& matrix, const VectorXd& gaps, VectorXd& settled, Progress& progress) {
  VectorXd forces = settled;
  VectorXd open = gaps;
  linalg::add_product(matrix, forces, open);
  std::vector<Index> set;
  set.reserve(static_cast<std::size_t>(forces.size()));
  for (int round = 0; round < most_sets && progress.report(); ++round) {
    set.clear();
    for (Index k = 0; k < forces.size(); ++k)
      if (matrix(k, k) > 0 && (forces[k] > 0 || (forces[k] == 0 && open[k] < 0)))
        set.push_back(k);
    const VectorXd pressed = linalg::solve_among(set, matrix, gaps);
    forces.setZero();
    for (std::size_t k = 0; k < set.size(); ++k)
      forces[set[k]] = pressed[static_cast<Index>(k)];
    open = gaps;
    linalg::add_product(matrix, forces, open);
    for (const Index k : set)
      open[k] = 0;
    if (is_nowhere_negative(forces) && is_nowhere_negative(open)) {
      settled = forces;
      return true;
    }
  }
  return false;
}

/// Changes by one point at a time.
class ActiveSet {
public:
  ActiveSet(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces)
      : matrix_(matrix), values_(values), forces_(forces) {
    for (Index k = 0; k < forces.size(); ++k)
      if (forces[k] > 0 && matrix(k, k) > 0)
        set_.push_back(k);
      else
        forces[k] = 0;
  }

  bool run(Progress& progress) {
    const Index most = 2 * most_changes * (forces_.size() + 1);
    for (Index round = 0; round < most && progress.report(); ++round) {
      const VectorXd wanted = wanted_forces();
      if (!wanted.allFinite())
        return false;
      if (!approach(wanted))
        continue;
      if (!join_most_violated())
        return true;
    }
    return false;
  }

private:
  /// Of the set, without a bound.
  VectorXd wanted_forces() const { return linalg::solve_among(set_, matrix_, values_); }

  /// Goes there as far as no force pulls. Whether that is all the way; else what has come to zero leaves.
  bool approach(const VectorXd& wanted) {
    double part = 1;
    for (std::size_t k = 0; k < set_.size(); ++k)
      if (const double now = forces_[set_[k]], then = wanted[static_cast<Index>(k)]; then < 0)
        part = std::min(part, now / (now - then));
    for (std::size_t k = 0; k < set_.size(); ++k) {
      const double now = forces_[set_[k]];
      const double then = wanted[static_cast<Index>(k)];
      const bool leaves = then < 0 && now <= part * (now - then);
      forces_[set_[k]] = leaves ? 0.0 : std::max(0.0, now + part * (then - now));
    }
    if (part == 1)
      return true;
    std::erase_if(set_, [&](Index k) { return forces_[k] == 0; });
    return false;
  }

  bool join_most_violated() {
    VectorXd open = values_;
    linalg::add_product(matrix_, forces_, open);
    for (const auto k : set_)
      open[k] = 0;
    Index worst = -1;
    double least = -rounding * linalg::largest_magnitude(values_);
    for (Index k = 0; k < open.size(); ++k)
      if (matrix_(k, k) > 0 && open[k] < least) {
        least = open[k];
        worst = k;
      }
    if (worst >= 0)
      set_.push_back(worst);
    return worst >= 0;
  }

  const MatrixXd& matrix_;
  const VectorXd& values_;
  VectorXd& forces_;
  std::vector<Index> set_;
};

/// The gradient's part on unknowns that are free to move, and its part that pushes bound ones inwards.
struct Gradients {
  VectorXd free;
  VectorXd chopped;
  Gradients(const VectorXd& x, const VectorXd& gradient)
      : free(VectorXd::Zero(x.size())), chopped(VectorXd::Zero(x.size())) {
    for (Index i = 0; i < x.size(); ++i)
      (x[i] > 0 ? free[i] : chopped[i]) = x[i] > 0 ? gradient[i] : std::min(gradient[i], 0.0);
  }
  double largest() const {
    return std::max(linalg::largest_magnitude(free), linalg::largest_magnitude(chopped));
  }
  /// The free gradient as far as one step of that length can follow it.
  VectorXd reduced_free(const VectorXd& x, double length) const {
    VectorXd reduced = free;
    for (Index i = 0; i < x.size(); ++i)
      if (free[i] > 0)
        reduced[i] = std::min(free[i], x[i] / length);
    return reduced;
  }
};

/// MPRGP with Γ = 1.
class Minimisation {
public:
  Minimisation(const NormalProducts& products, const VectorXd& values, VectorXd start)
      : products_(products), values_(values), x_(std::move(start)) {
    gradient_ = values;
    if (linalg::largest_magnitude(x_) != 0)
      gradient_ += product(x_);
    length_ = 1 / operator_norm();
  }

  std::optional<VectorXd> run(const CgLimits& limits, Progress& progress) {
    restart();
    for (int iteration = 0; iteration < limits.max_iterations; ++iteration) {
      const Gradients gradients(x_, gradient_);
      if (gradients.largest() <= limits.tolerance)
        return x_;
      const bool proportional =
          gradients.chopped.squaredNorm() <= gradients.reduced_free(x_, length_).dot(gradients.free);
      if (proportional)
        conjugate_step();
      else
        proportion(gradients.chopped);
      if (!progress.report())
        return std::nullopt;
    }
    return std::nullopt;
  }

private:
  double operator_norm() const {
    VectorXd v(x_.size());
    const auto last = static_cast<double>(v.size() - 1);
    for (Index i = 0; i < v.size(); ++i)
      v[i] = i == v.size() - 1 ? 2 : 1 + static_cast<double>(i) * (1 / last);
    double norm = 0;
    for (int i = 0; i < products_.norm_products; ++i) {
      if (const double length = v.norm(); length > 0)
        v /= length;
      v = product(v);
      norm = v.norm();
    }
    return std::max(norm, std::numeric_limits<double>::min());
  }

  VectorXd preconditioned() const {
    const Gradients gradients(x_, gradient_);
    VectorXd z = products_.precondition(gradients.free);
    for (Index i = 0; i < z.size(); ++i)
      if (!(x_[i] > 0))
        z[i] = 0;
    return z;
  }

  void restart() { direction_ = preconditioned(); }

  void conjugate_step() {
    const VectorXd moved = product(direction_);
    const double curvature = direction_.dot(moved);
    const double wanted = gradient_.dot(direction_) / curvature;
    const double feasible = largest_feasible_step();
    if (wanted <= feasible) {
      go(wanted, direction_);
      gradient_ -= wanted * moved;
      VectorXd z = preconditioned();
      z -= z.dot(moved) / curvature * direction_;
      direction_.swap(z);
      return;
    }
    go(feasible, direction_);
    gradient_ -= feasible * moved;
    go(length_, Gradients(x_, gradient_).free);
    gradient_ = product(x_);
    gradient_ += values_;
    restart();
  }

  /// Against the direction, as far as no force becomes negative.
  void go(double step, const VectorXd& direction) {
    for (Index i = 0; i < x_.size(); ++i)
      x_[i] = std::max(0.0, x_[i] - step * direction[i]);
  }

  double largest_feasible_step() const {
    double step = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < x_.size(); ++i)
      if (direction_[i] > 0)
        step = std::min(step, x_[i] / direction_[i]);
    return step;
  }

  void proportion(const VectorXd& chopped) {
    const VectorXd moved = product(chopped);
    const double step = gradient_.dot(chopped) / chopped.dot(moved);
    go(step, chopped);
    gradient_ -= step * moved;
    restart();
  }

  VectorXd product(const VectorXd& x) const { return products_.matrix(x); }

  const NormalProducts& products_;
  const VectorXd& values_;
  VectorXd x_;
  VectorXd gradient_;
  VectorXd direction_;
  double length_ = 1; ///< of a gradient step that never overshoots
};

/// Points that can move along their normals: a normal that only rounding turns out of what is held does not.
std::vector<Index> movable(const MatrixXd& matrix) {
  double stiffest = -std::numeric_limits<double>::infinity();
  for (Index k = 0; k < matrix.rows(); ++k)
    stiffest = std::max(stiffest, matrix(k, k));
  const double least = tolerances.empty_row * tolerances.empty_row * stiffest;
  std::vector<Index> points;
  for (Index k = 0; k < matrix.rows(); ++k)
    if (matrix(k, k) > least)
      points.push_back(k);
  return points;
}

/// Whether it came to its end; else the forces stay as they were.
bool conjugate_gradients(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces,
                         Progress& progress) {
  const auto points = movable(matrix);
  const auto count = static_cast<Index>(points.size());
  VectorXd gaps(count), start(count);
  MatrixXd among(count, count);
  for (Index j = 0; j < count; ++j) {
    const Index point = points[static_cast<std::size_t>(j)];
    gaps[j] = values[point];
    start[j] = forces[point];
    for (Index i = 0; i < count; ++i)
      among(i, j) = matrix(points[static_cast<std::size_t>(i)], point);
  }
  const CgLimits limits{gap_tolerance * linalg::largest_magnitude(gaps),
                        least_iterations + iterations_per_unknown * static_cast<int>(count)};
  const auto found = minimise_over_nonnegative(among, gaps, std::move(start), limits, progress);
  if (!found)
    return false;
  forces.setZero();
  for (Index j = 0; j < count; ++j)
    forces[points[static_cast<std::size_t>(j)]] = (*found)[j];
  return true;
}

} // namespace

bool solve_normal_problem(const MatrixXd& matrix, const VectorXd& values, NormalSolution how_far,
                          VectorXd& forces, Progress& progress) {
  if (how_far == NormalSolution::projected_cg && conjugate_gradients(matrix, values, forces, progress))
    return true;
  normal_gauss_seidel(matrix, values, forces);
  if (normal_active_set(matrix, values, forces, progress))
    return true;
  return how_far != NormalSolution::near && solve_complementarity(matrix, values, forces, progress);
}

void normal_gauss_seidel(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces) {
  VectorXd open = values;
  linalg::add_product(matrix, forces, open);
  for (int round = 0; round < most_sweeps; ++round) {
    bool turned = false;
    double largest_change = 0;
    for (Index i = 0; i < forces.size(); ++i) {
      if (matrix(i, i) <= 0)
        continue; // between parts that are held
      const double wanted = std::max(0.0, forces[i] - open[i] / matrix(i, i));
      const double change = wanted - forces[i];
      if (change == 0)
        continue;
      turned = turned || (wanted > 0) != (forces[i] > 0);
      largest_change = std::max(largest_change, std::abs(change));
      forces[i] = wanted;
      open += change * matrix.col(i);
    }
    double most = -std::numeric_limits<double>::infinity();
    for (const double force : forces)
      most = std::max(most, force);
    if (!turned && largest_change <= good_enough * most)
      return;
  }
}

bool solve_complementarity(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces,
                           Progress& progress) {
  return ActiveSet(matrix, values, forces).run(progress);
}

std::optional<VectorXd> minimise_over_nonnegative(const NormalProducts& products, const VectorXd& values,
                                                  VectorXd start, const CgLimits& limits,
                                                  Progress& progress) {
  return Minimisation(products, values, std::move(start)).run(limits, progress);
}

std::optional<VectorXd> minimise_over_nonnegative(const MatrixXd& matrix, const VectorXd& values,
                                                  VectorXd start, const CgLimits& limits,
                                                  Progress& progress) {
  const NormalProducts products{[&](const VectorXd& forces) { return linalg::product(matrix, forces); },
                                [&](const VectorXd& gaps) {
                                  VectorXd forces = gaps;
                                  for (Index k = 0; k < forces.size(); ++k)
                                    forces[k] /= matrix(k, k);
                                  return forces;
                                },
                                norm_products};
  return minimise_over_nonnegative(products, values, std::move(start), limits, progress);
}

} // namespace rubato::step
