// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/contact_guess.hpp"

#include "rubato/linalg/dense_cholesky.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
/// Along the slips of a point.
using Tangential = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 2, 1>;

constexpr int most_sweeps = 50;
/// Change in a sweep, in parts of the largest force, that a guess needs no better than.
constexpr double good_enough = 1e-2;
constexpr int most_sets = 30;
/// Points that the forces of others push into the master join in so many rounds.
constexpr int most_rounds = 8;
/// Those join first that are pushed in by this part of the deepest.
constexpr double deep = 0.6;

/// Gap and slips with the surface at d.
Vector3d measures_of(const GuessPoint& point, const VectorXd& d) {
  Vector3d moved = Vector3d::Zero();
  for (const auto& share : point.shares)
    moved[share.component] += share.weight * d[share.position];
  return point.value + point.frame.transpose() * moved;
}

/// Primal-dual active set from what the sweeps have found; keeps that when the set doesn't settle.
void settle_pressing(const MatrixXd& matrix, const VectorXd& gaps, VectorXd& settled) {
  VectorXd forces = settled;
  VectorXd open = gaps;
  open.noalias() += matrix * forces;
  std::vector<int> set;
  set.reserve(static_cast<std::size_t>(forces.size()));
  for (int round = 0; round < most_sets; ++round) {
    set.clear();
    for (Index k = 0; k < forces.size(); ++k)
      if (matrix(k, k) > 0 && (forces[k] > 0 || (forces[k] == 0 && open[k] < 0)))
        set.push_back(static_cast<int>(k));
    const VectorXd pressed = linalg::solve_positive_definite(matrix(set, set), -gaps(set));
    forces.setZero();
    forces(set) = pressed;
    open = gaps;
    open.noalias() += matrix * forces;
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
  VectorXd moved = slips;
  moved.noalias() += matrix * forces;
  VectorXd next, held;
  std::vector<int> sticking;
  sticking.reserve(static_cast<std::size_t>(forces.size()));
  for (int round = 0; round < most_sets; ++round) {
    sticking.clear();
    next.setZero(forces.size()); // at the bounds first
    for (Index k = 0; k < forces.size(); ++k) {
      const double pulled = forces[k] - moved[k] / std::max(matrix(k, k), 1e-300);
      if (matrix(k, k) > 0 && std::abs(pulled) < limits[k])
        sticking.push_back(static_cast<int>(k));
      else
        next[k] = std::copysign(limits[k], pulled);
    }
    held = slips;
    held.noalias() += matrix * next;
    const VectorXd pulled_back = linalg::solve_positive_definite(matrix(sticking, sticking), -held(sticking));
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

void add_force(std::span<const GuessPoint> points, int first, int last, VectorXd& force) {
  for (const auto& point : points) {
    if (point.force[0] == 0)
      continue;
    Vector3d in_space = Vector3d::Zero();
    for (int a = first; a <= last; ++a)
      in_space += point.force[a] * point.frame.col(a);
    for (const auto& share : point.shares)
      force[share.position] += share.weight * in_space[share.component];
  }
}

ContactGuess::ContactGuess(Compliance& compliance, TouchedSurface& surface, double factor, int components)
    : compliance_(compliance), surface_(surface), factor_(factor), components_(components) {}

void ContactGuess::improve(std::span<GuessPoint> points, const VectorXd& free) {
  forget();
  VectorXd unpressed = free;
  add_motion(points, 1, 2, unpressed);
  VectorXd d = unpressed;
  add_motion(points, 0, 0, d);
  for (int round = 0; round < most_rounds && choose_more(points, d); ++round) {
    couple();
    press(unpressed);
    d = unpressed;
    add_motion(points, 0, 0, d);
  }
  rub(points, free + d - unpressed);
}

double ContactGuess::misfit(std::span<const GuessPoint> points, const VectorXd& d) const {
  double change = 0;
  double largest = 0;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const auto& point = *chosen_[k];
    const double give = give_of(k) + point.softness;
    const double gap = measures_of(point, d)[0] + point.softness * point.force[0];
    if (give > 0)
      change = std::max(change, std::abs(std::max(0.0, point.force[0] - gap / give) - point.force[0]));
    largest = std::max(largest, point.force[0]);
  }
  const Index tangents = components_ - 1;
  for (std::size_t k = 0; k < sliding_.size(); ++k) {
    const auto& point = *chosen_[sliding_[k]];
    const double give = rubbing_.diagonal().segment(static_cast<Index>(k) * tangents, tangents).maxCoeff();
    const double limit = point.friction * point.force[0];
    Eigen::Vector2d wanted = point.force.tail<2>();
    if (give > 0)
      wanted.head(tangents) -= measures_of(point, d).segment(1, tangents) / give;
    if (const double length = wanted.norm(); length > limit)
      wanted *= limit / length;
    change = std::max(change, (wanted - point.force.tail<2>()).lpNorm<Eigen::Infinity>());
  }
  const double give = chosen_.empty() ? 0.0 : pressing_.diagonal().maxCoeff();
  for (const auto& point : points)
    if (point.force[0] == 0)
      if (const double gap = measures_of(point, d)[0]; gap < 0)
        change = std::max(change, give > 0 ? -gap / give : std::numeric_limits<double>::infinity());
  return change > 0 ? change / largest : 0.0;
}

/// How far a unit pressing force opens its own gap.
double ContactGuess::give_of(std::size_t chosen) const {
  return pressing_(static_cast<Index>(chosen), static_cast<Index>(chosen));
}

void ContactGuess::forget() {
  chosen_.clear();
  sliding_.clear();
  between_.resize(0, 0);
}

/// Moves the surface by some of the forces of all points.
void ContactGuess::add_motion(std::span<const GuessPoint> points, int first, int last, VectorXd& d) {
  force_.setZero(d.size());
  add_force(points, first, last, force_);
  compliance_.add(factor_, force_, d);
}

/// Points that press, and those that penetrate deepest, join those that are chosen already. Whether there are
/// any.
bool ContactGuess::choose_more(std::span<GuessPoint> points, const VectorXd& d) {
  const auto known = static_cast<std::ptrdiff_t>(chosen_.size());
  const auto is_known = [&](const GuessPoint& point) {
    return std::find(chosen_.begin(), chosen_.begin() + known, &point) != chosen_.begin() + known;
  };
  gaps_.resize(points.size());
  double deepest = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    gaps_[i] = is_known(points[i]) ? 0.0 : measures_of(points[i], d)[0];
    deepest = std::min(deepest, gaps_[i]);
  }
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((gaps_[i] < 0 && gaps_[i] <= deep * deepest) || (points[i].force[0] > 0 && !is_known(points[i])))
      chosen_.push_back(&points[i]);
  return static_cast<std::ptrdiff_t>(chosen_.size()) > known;
}

/// What the chosen points do to one another. Places of the surface shift when there are new ones.
void ContactGuess::couple() {
  for (const auto* point : chosen_)
    for (const auto& share : point->shares)
      surface_.add({&share.position, 1});
  surface_.touch_added();
  rows_.resize(std::max(rows_.size(), chosen_.size()));
  std::vector<const PointRows*> rows;
  rows.reserve(chosen_.size());
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    place(*chosen_[k], rows_[k]);
    rows.push_back(&rows_[k]);
  }
  extend_between_points(surface_, rows, components_, factor_, between_);
}

void ContactGuess::place(const GuessPoint& point, PointRows& rows) const {
  rows.places.clear();
  rows.right.setZero(components_, static_cast<Index>(point.shares.size()));
  for (const auto& share : point.shares) {
    rows.right(share.component, static_cast<Index>(rows.places.size())) = share.weight;
    rows.places.push_back(surface_.place_of(share.position));
  }
  rows.left = rows.right;
}

/// What forces along some axes of points do to the measures along theirs: `axes` columns from `first` of each
/// frame.
void ContactGuess::project(std::span<const std::size_t> chosen, int first, Index axes, MatrixXd& matrix) {
  const auto count = static_cast<Index>(chosen.size());
  matrix.resize(count * axes, count * axes);
  for (Index j = 0; j < count; ++j) {
    const auto of = chosen[static_cast<std::size_t>(j)];
    for (Index b = 0; b < axes; ++b) {
      const double* along = chosen_[of]->frame.col(first + b).data();
      const double* column = between_.col(static_cast<Index>(of) * components_).data();
      moved_.setZero(between_.rows());
      for (Index c = 0; c < components_; ++c, column += between_.rows())
        for (Index row = 0; row < between_.rows(); ++row)
          moved_[row] += along[c] * column[row];
      for (Index i = 0; i < count; ++i) {
        const auto on = chosen[static_cast<std::size_t>(i)];
        const double* seen = moved_.data() + static_cast<Index>(on) * components_;
        for (Index a = 0; a < axes; ++a) {
          const double* axis = chosen_[on]->frame.col(first + a).data();
          double sum = 0;
          for (Index c = 0; c < components_; ++c)
            sum += axis[c] * seen[c];
          matrix(i * axes + a, j * axes + b) = sum;
        }
      }
    }
  }
}

/// `without`: the surface without pressing forces.
void ContactGuess::press(const VectorXd& without) {
  const auto count = static_cast<Index>(chosen_.size());
  all_.resize(chosen_.size());
  std::iota(all_.begin(), all_.end(), 0);
  project(all_, 0, 1, pressing_);
  VectorXd gaps(count);
  VectorXd forces(count);
  MatrixXd matrix = pressing_;
  for (Index k = 0; k < count; ++k) {
    const auto& point = *chosen_[static_cast<std::size_t>(k)];
    gaps[k] = measures_of(point, without)[0];
    forces[k] = point.force[0];
    matrix(k, k) += point.softness;
  }
  sweep_pressing(matrix, gaps, forces);
  settle_pressing(matrix, gaps, forces);
  for (Index k = 0; k < count; ++k)
    chosen_[static_cast<std::size_t>(k)]->force[0] = forces[k];
}

/// `without`: the surface under the pressing forces alone.
void ContactGuess::rub(std::span<GuessPoint> points, const VectorXd& without) {
  for (auto& point : points)
    if (point.force[0] == 0 || point.friction == 0)
      point.force.tail<2>().setZero();
  sliding_.clear();
  for (std::size_t k = 0; k < chosen_.size(); ++k)
    if (chosen_[k]->force[0] > 0 && chosen_[k]->friction > 0)
      sliding_.push_back(k);
  if (sliding_.empty())
    return;
  const Index tangents = components_ - 1;
  project(sliding_, 1, tangents, rubbing_);
  VectorXd slips(rubbing_.rows());
  VectorXd forces(rubbing_.rows());
  VectorXd limits(static_cast<Index>(sliding_.size()));
  for (Index k = 0; k < limits.size(); ++k) {
    const auto& point = *chosen_[sliding_[static_cast<std::size_t>(k)]];
    slips.segment(k * tangents, tangents) = measures_of(point, without).segment(1, tangents);
    forces.segment(k * tangents, tangents) = point.force.segment(1, tangents);
    limits[k] = point.friction * point.force[0];
  }
  sweep_rubbing(rubbing_, slips, limits, static_cast<int>(tangents), forces);
  if (tangents == 1)
    settle_rubbing(rubbing_, slips, limits, forces);
  for (Index k = 0; k < limits.size(); ++k)
    chosen_[sliding_[static_cast<std::size_t>(k)]]->force.segment(1, tangents) =
        forces.segment(k * tangents, tangents);
}

void sweep_pressing(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces) {
  VectorXd open = values;
  open.noalias() += matrix * forces;
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
  VectorXd slips = values;
  slips.noalias() += matrix * forces;
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
