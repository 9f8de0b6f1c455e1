// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/contact_guess.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_sweeps = 50;
/// Change in a sweep, in parts of the largest force, that a guess needs no better than.
constexpr double good_enough = 1e-2;
constexpr int most_sets = 30;
/// Points that the forces of others push into the master join in so many rounds.
constexpr int most_rounds = 4;

double value_of(const GuessPoint& point, int row, const VectorXd& d) {
  const auto& slopes = point.slopes[static_cast<std::size_t>(row)];
  double value = point.value[row];
  for (std::size_t i = 0; i < slopes.size(); ++i)
    value += slopes[i] * d[point.positions[i]];
  return value;
}

/// Gaps or slips of points that forces along them change: value = … + matrix F.
class Rows {
public:
  Rows(double factor, Compliance& compliance, Index surface)
      : factor_(factor), compliance_(compliance), moved_(surface) {}

  Index size() const { return static_cast<Index>(rows_.size()); }
  const MatrixXd& matrix() const { return matrix_; }

  void reserve(Index size) { matrix_.conservativeResize(size, size); }

  /// The matrix must have room for it.
  void add(const GuessPoint& point, int row) {
    const Index k = size();
    rows_.push_back({&point, row});
    moved_.setZero();
    compliance_.add(factor_, point.positions, point.slopes[static_cast<std::size_t>(row)], moved_);
    for (Index other = 0; other <= k; ++other)
      matrix_(other, k) = matrix_(k, other) = along(rows_[static_cast<std::size_t>(other)]);
  }
  void soften(double softness) { matrix_(size() - 1, size() - 1) += softness; }

private:
  struct Row {
    const GuessPoint* point;
    int row;
  };
  double along(const Row& row) const {
    const auto& slopes = row.point->slopes[static_cast<std::size_t>(row.row)];
    double sum = 0;
    for (std::size_t i = 0; i < slopes.size(); ++i)
      sum += slopes[i] * moved_[row.point->positions[i]];
    return sum;
  }

  double factor_;
  Compliance& compliance_;
  std::vector<Row> rows_;
  MatrixXd matrix_;
  VectorXd moved_;
};

class Guess {
public:
  Guess(std::span<GuessPoint> points, const VectorXd& free, double factor, Compliance& compliance)
      : points_(points), free_(free), factor_(factor), compliance_(compliance) {}

  void run() {
    press();
    rub();
  }

private:
  void prepare(std::span<GuessPoint* const> points) {
    std::vector<int> positions;
    for (const auto* point : points)
      positions.insert(positions.end(), point->positions.begin(), point->positions.end());
    std::ranges::sort(positions);
    positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
    compliance_.prepare(positions);
  }

  /// The surface under the forces of some rows.
  VectorXd moved_by(int first_row, int last_row) const {
    VectorXd force = VectorXd::Zero(free_.size());
    for (const auto& point : points_)
      for (int row = first_row; row <= last_row; ++row)
        for (std::size_t i = 0; point.force[row] != 0 && i < point.positions.size(); ++i)
          force[point.positions[i]] += point.force[row] * point.slopes[static_cast<std::size_t>(row)][i];
    VectorXd d = free_;
    compliance_.add(factor_, force, d);
    return d;
  }

  void press() {
    const VectorXd without = moved_by(1, 2);
    Rows rows(factor_, compliance_, free_.size());
    std::vector<GuessPoint*> chosen;
    std::vector<bool> known(points_.size(), false);
    VectorXd forces;
    for (int round = 0; round < most_rounds; ++round) {
      const VectorXd d = moved_by(0, 2);
      std::vector<GuessPoint*> more;
      for (std::size_t i = 0; i < points_.size(); ++i)
        if (!known[i] && (points_[i].force[0] > 0 || value_of(points_[i], 0, d) < 0)) {
          known[i] = true;
          more.push_back(&points_[i]);
        }
      if (more.empty())
        return;
      prepare(more);
      rows.reserve(rows.size() + static_cast<Index>(more.size()));
      for (auto* point : more) {
        rows.add(*point, 0);
        rows.soften(point->softness);
        chosen.push_back(point);
      }
      VectorXd gaps(rows.size());
      forces.resize(rows.size());
      for (Index k = 0; k < rows.size(); ++k) {
        gaps[k] = value_of(*chosen[static_cast<std::size_t>(k)], 0, without);
        forces[k] = chosen[static_cast<std::size_t>(k)]->force[0];
      }
      sweep_pressing(rows.matrix(), gaps, forces);
      settle_pressing(rows.matrix(), gaps, forces);
      for (Index k = 0; k < rows.size(); ++k)
        chosen[static_cast<std::size_t>(k)]->force[0] = forces[k];
    }
  }

  /// Primal-dual active set from what the sweeps have found; keeps that when the set doesn't settle.
  static void settle_pressing(const MatrixXd& matrix, const VectorXd& gaps, VectorXd& settled) {
    VectorXd forces = settled;
    VectorXd open = gaps + matrix * forces;
    for (int round = 0; round < most_sets; ++round) {
      std::vector<int> set;
      for (Index k = 0; k < forces.size(); ++k)
        if (matrix(k, k) > 0 && (forces[k] > 0 || (forces[k] == 0 && open[k] < 0)))
          set.push_back(static_cast<int>(k));
      const VectorXd pressed = MatrixXd(matrix(set, set)).llt().solve(VectorXd(-gaps(set)));
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

  void rub() {
    std::vector<GuessPoint*> chosen;
    for (auto& point : points_)
      if (point.force[0] > 0 && point.friction > 0)
        chosen.push_back(&point);
      else
        point.force.tail<2>().setZero();
    if (chosen.empty())
      return;
    const VectorXd without = moved_by(0, 0);
    const int tangents = chosen.front()->tangents;
    const auto size = static_cast<Index>(chosen.size()) * tangents;
    Rows rows(factor_, compliance_, free_.size());
    rows.reserve(size);
    VectorXd slips(size);
    VectorXd forces(size);
    VectorXd limits(static_cast<Index>(chosen.size()));
    for (Index k = 0; k < limits.size(); ++k) {
      const auto& point = *chosen[static_cast<std::size_t>(k)];
      limits[k] = point.friction * point.force[0];
      for (int a = 0; a < tangents; ++a) {
        rows.add(point, 1 + a);
        slips[k * tangents + a] = value_of(point, 1 + a, without);
        forces[k * tangents + a] = point.force[1 + a];
      }
    }
    sweep_rubbing(rows.matrix(), slips, limits, tangents, forces);
    if (tangents == 1)
      settle_rubbing(rows.matrix(), slips, limits, forces);
    for (Index k = 0; k < limits.size(); ++k)
      for (int a = 0; a < tangents; ++a)
        chosen[static_cast<std::size_t>(k)]->force[1 + a] = forces[k * tangents + a];
  }

  /// The same between bounds.
  static void settle_rubbing(const MatrixXd& matrix, const VectorXd& slips, const VectorXd& limits,
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
      const VectorXd pulled_back =
          MatrixXd(matrix(sticking, sticking)).llt().solve(VectorXd(-held(sticking)));
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

  std::span<GuessPoint> points_;
  const VectorXd& free_;
  double factor_;
  Compliance& compliance_;
};

} // namespace

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
      VectorXd wanted = forces.segment(first, tangents) - slips.segment(first, tangents) / stiffest;
      if (const double length = wanted.norm(); length > limits[i])
        wanted *= limits[i] / length;
      const VectorXd change = wanted - forces.segment(first, tangents);
      largest_change = std::max(largest_change, change.lpNorm<Eigen::Infinity>());
      forces.segment(first, tangents) = wanted;
      for (Index a = 0; a < tangents; ++a)
        slips += change[a] * matrix.col(first + a);
    }
    if (largest_change <= good_enough * limits.maxCoeff())
      return;
  }
}

void guess_forces(std::span<GuessPoint> points, const VectorXd& free, double factor, Compliance& compliance) {
  Guess(points, free, factor, compliance).run();
}

} // namespace rubato::step
