// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/contact_guess.hpp"

#include "rubato/linalg/dense_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
/// Along the slips of a point.
using Tangential = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;

constexpr int most_sweeps = 50;
/// Change in a sweep, in parts of the largest force, that a guess needs no better than.
constexpr double good_enough = 1e-2;
constexpr int most_sets = 30;
/// Points that the forces of others push into the master join in so many rounds.
constexpr int most_rounds = 4;

double value_of(const GuessPoint& point, int row, const VectorXd& d) {
  double value = point.value[row];
  for (std::size_t i = 0; i < point.positions.size(); ++i)
    value += point.slopes(row, static_cast<Index>(i)) * d[point.positions[i]];
  return value;
}

/// Primal-dual active set from what the sweeps have found; keeps that when the set doesn't settle.
void settle_pressing(const MatrixXd& matrix, const VectorXd& gaps, VectorXd& settled) {
  VectorXd forces = settled;
  VectorXd open = gaps + matrix * forces;
  std::vector<int> set;
  for (int round = 0; round < most_sets; ++round) {
    set.clear();
    for (Index k = 0; k < forces.size(); ++k)
      if (matrix(k, k) > 0 && (forces[k] > 0 || (forces[k] == 0 && open[k] < 0)))
        set.push_back(static_cast<int>(k));
    const VectorXd pressed = linalg::solve_positive_definite(matrix(set, set), -gaps(set));
    forces.setZero();
    forces(set) = pressed;
    open = gaps + matrix * forces;
    open(set).setZero();
    if ((forces.array() >= 0).all() && (open.array() >= 0).all()) {
      settled = forces;
      return;
    }
  }
}

/// The same between bounds.
void settle_rubbing(const MatrixXd& matrix, const VectorXd& slips, const VectorXd& limits,
                    VectorXd& settled) {
  VectorXd forces = settled;
  VectorXd moved = slips + matrix * forces;
  for (int round = 0; round < most_sets; ++round) {
    std::vector<int> sticking;
    VectorXd bound = VectorXd::Zero(forces.size());
    for (Index k = 0; k < forces.size(); ++k) {
      const double pulled = forces[k] - moved[k] / std::max(matrix(k, k), 1e-300);
      if (matrix(k, k) > 0 && std::abs(pulled) < limits[k])
        sticking.push_back(static_cast<int>(k));
      else
        bound[k] = std::copysign(limits[k], pulled);
    }
    const VectorXd held = slips + matrix * bound;
    VectorXd next = bound;
    const VectorXd pulled_back = linalg::solve_positive_definite(matrix(sticking, sticking), -held(sticking));
    for (std::size_t k = 0; k < sticking.size(); ++k)
      next[sticking[k]] = pulled_back[static_cast<Index>(k)];
    const bool same = (next - forces).lpNorm<Eigen::Infinity>() <= 1e-9 * limits.maxCoeff();
    forces = next;
    moved = slips + matrix * forces;
    if (same) {
      settled = forces;
      return;
    }
  }
}

} // namespace

ContactGuess::ContactGuess(Compliance& compliance, TouchedSurface& surface, double factor)
    : compliance_(compliance), surface_(surface), factor_(factor) {}

void ContactGuess::improve(std::span<GuessPoint> points, const VectorXd& free) {
  chosen_.clear();
  const VectorXd without = moved(points, free, 1, 2);
  for (int round = 0; round < most_rounds && choose_more(points, free); ++round) {
    couple(chosen_, 0, 1, pressing_);
    press(without);
  }
  rub(points, free);
}

double ContactGuess::misfit(std::span<const GuessPoint> points, const VectorXd& d) const {
  double change = 0;
  double largest = 0;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const auto& point = *chosen_[k];
    const auto row = static_cast<Index>(k);
    const double give = pressing_.matrix(row, row) + point.softness;
    const double gap = value_of(point, 0, d) + point.softness * point.force[0];
    if (give > 0)
      change = std::max(change, std::abs(std::max(0.0, point.force[0] - gap / give) - point.force[0]));
    largest = std::max(largest, point.force[0]);
  }
  for (std::size_t k = 0; k < sliding_.size(); ++k) {
    const auto& point = *sliding_[k];
    const Index tangents = point.tangents();
    const double give =
        rubbing_.matrix.diagonal().segment(static_cast<Index>(k) * tangents, tangents).maxCoeff();
    const double limit = point.friction * point.force[0];
    Eigen::Vector2d wanted = point.force.tail<2>();
    for (int a = 0; give > 0 && a < tangents; ++a)
      wanted[a] -= value_of(point, 1 + a, d) / give;
    if (const double length = wanted.norm(); length > limit)
      wanted *= limit / length;
    change = std::max(change, (wanted - point.force.tail<2>()).lpNorm<Eigen::Infinity>());
  }
  const double give = chosen_.empty() ? 0.0 : pressing_.matrix.diagonal().maxCoeff();
  for (const auto& point : points)
    if (const double gap = value_of(point, 0, d); point.force[0] == 0 && gap < 0)
      change = std::max(change, give > 0 ? -gap / give : std::numeric_limits<double>::infinity());
  return change > 0 ? change / largest : 0.0;
}

void ContactGuess::forget() {
  chosen_.clear();
  sliding_.clear();
  pressing_.points.clear();
  rubbing_.points.clear();
}

/// The surface under the forces of some rows of all points.
VectorXd ContactGuess::moved(std::span<const GuessPoint> points, const VectorXd& free, int first_row,
                             int last_row) const {
  VectorXd force = VectorXd::Zero(free.size());
  for (const auto& point : points)
    for (Index row = first_row; row <= std::min<Index>(last_row, point.tangents()); ++row)
      for (std::size_t i = 0; point.force[row] != 0 && i < point.positions.size(); ++i)
        force[point.positions[i]] += point.force[row] * point.slopes(row, static_cast<Index>(i));
  VectorXd d = free;
  compliance_.add(factor_, force, d);
  return d;
}

/// Points that press or penetrate join those that are chosen already. Whether there are any.
bool ContactGuess::choose_more(std::span<GuessPoint> points, const VectorXd& free) {
  const VectorXd d = moved(points, free, 0, 2);
  const auto known = chosen_.size();
  for (auto& point : points)
    if ((point.force[0] > 0 || value_of(point, 0, d) < 0) &&
        std::find(chosen_.begin(), chosen_.begin() + static_cast<std::ptrdiff_t>(known), &point) ==
            chosen_.begin() + static_cast<std::ptrdiff_t>(known))
      chosen_.push_back(&point);
  return chosen_.size() > known;
}

void ContactGuess::couple(std::span<GuessPoint* const> points, Index first_row, Index rows,
                          Coupling& coupling) {
  const auto is_named = [](const GuessPoint* point, const Coupling::Name& name) {
    return Coupling::Name{point->zone, point->index} == name;
  };
  if (std::ranges::equal(points, coupling.points, is_named))
    return;
  coupling.points.clear();
  std::vector<int> positions;
  for (const auto* point : points) {
    coupling.points.push_back({point->zone, point->index});
    positions.insert(positions.end(), point->positions.begin(), point->positions.end());
  }
  surface_.touch(positions);
  rows_.resize(std::max(rows_.size(), points.size()));
  std::vector<const PointRows*> pointers;
  for (std::size_t k = 0; k < points.size(); ++k) {
    auto& of_point = rows_[k];
    of_point.places.clear();
    for (const int position : points[k]->positions)
      of_point.places.push_back(surface_.place_of(position));
    of_point.left = of_point.right = points[k]->slopes.middleRows(first_row, rows);
    of_point.first = static_cast<Index>(k) * rows;
    pointers.push_back(&of_point);
  }
  coupling.matrix = between_points(surface_, pointers, factor_, true);
}

/// `without`: the surface without pressing forces.
void ContactGuess::press(const VectorXd& without) {
  MatrixXd matrix = pressing_.matrix;
  VectorXd gaps(matrix.rows());
  VectorXd forces(matrix.rows());
  for (Index k = 0; k < gaps.size(); ++k) {
    const auto& point = *chosen_[static_cast<std::size_t>(k)];
    matrix(k, k) += point.softness;
    gaps[k] = value_of(point, 0, without);
    forces[k] = point.force[0];
  }
  sweep_pressing(matrix, gaps, forces);
  settle_pressing(matrix, gaps, forces);
  for (Index k = 0; k < gaps.size(); ++k)
    chosen_[static_cast<std::size_t>(k)]->force[0] = forces[k];
}

void ContactGuess::rub(std::span<GuessPoint> points, const VectorXd& free) {
  auto& rubbing = sliding_;
  rubbing.clear();
  for (auto& point : points)
    if (point.force[0] > 0 && point.friction > 0)
      rubbing.push_back(&point);
    else
      point.force.tail<2>().setZero();
  if (rubbing.empty())
    return;
  const Index tangents = rubbing.front()->tangents();
  couple(rubbing, 1, tangents, rubbing_);
  const VectorXd without = moved(points, free, 0, 0);
  VectorXd slips(rubbing_.matrix.rows());
  VectorXd forces(slips.size());
  VectorXd limits(static_cast<Index>(rubbing.size()));
  for (Index k = 0; k < limits.size(); ++k) {
    const auto& point = *rubbing[static_cast<std::size_t>(k)];
    limits[k] = point.friction * point.force[0];
    for (Index a = 0; a < tangents; ++a)
      slips[k * tangents + a] = value_of(point, static_cast<int>(1 + a), without);
    forces.segment(k * tangents, tangents) = point.force.segment(1, tangents);
  }
  sweep_rubbing(rubbing_.matrix, slips, limits, static_cast<int>(tangents), forces);
  if (tangents == 1)
    settle_rubbing(rubbing_.matrix, slips, limits, forces);
  for (Index k = 0; k < limits.size(); ++k)
    rubbing[static_cast<std::size_t>(k)]->force.segment(1, tangents) = forces.segment(k * tangents, tangents);
}

void sweep_pressing(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces) {
  VectorXd open = values + matrix * forces;
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
    if (!turned && largest_change <= good_enough * forces.maxCoeff())
      return;
  }
}

void sweep_rubbing(const MatrixXd& matrix, const VectorXd& values, const VectorXd& limits, int tangents,
                   VectorXd& forces) {
  VectorXd slips = values + matrix * forces;
  for (int round = 0; round < most_sweeps; ++round) {
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
    if (largest_change <= good_enough * limits.maxCoeff())
      return;
  }
}

} // namespace rubato::step
