// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/friction_cones.hpp"

#include "rubato/linalg/dense_cholesky.hpp"
#include "rubato/linalg/dense_lu.hpp"
#include "rubato/linalg/dense_products.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_newton_steps = 30;
constexpr int most_halvings = 6;
/// Part of what is left that a whole move has to take away, a shorter one less.
constexpr double least_progress = 0.1;
/// What may be left, in parts of the largest force.
constexpr double tolerance = 1e-9;
/// Of motions against forces, in parts of how far a unit force moves its own point. It decides which points
/// press and stick on the way, not the answer: with the compliance of a point's surface alone, gaps that are
/// traces of a rigid motion would let points go that press.
constexpr double usual_augmentation = 10;
/// Where the iterates come back to one another with the usual one.
constexpr double other_augmentation = 1;

/// Of a point with two or three components: a column each.
using PointMatrix = std::array<std::array<double, 3>, 3>;

/// Newton's method on F = projection of F − augmentation w, friction's limit following the pressing force.
class Iteration {
public:
  Iteration(const FrictionCones& cones, double augmentation, VectorXd forces)
      : cones_(cones), augmentation_(augmentation), forces_(std::move(forces)),
        size_(forces_.size() / cones.friction.size()),
        slopes_(static_cast<std::size_t>(cones.friction.size())) {}

  bool run(Progress& progress) {
    linearise(forces_);
    for (int round = 0; round < most_newton_steps && progress.report() && left_.allFinite(); ++round) {
      if (linalg::largest_magnitude(left_) <= tolerance * linalg::largest_magnitude(forces_)) {
        forces_ -= left_;
        return true;
      }
      const auto whole = move();
      if (!whole)
        return false;
      take(*whole);
    }
    return false;
  }

  const VectorXd& forces() const { return forces_; }

private:
  /// d left = of_force dF + of_motion dw, of a point's own force and motion. A point that is not pressed has
  /// left = F.
  struct Slope {
    bool pressed = false;
    PointMatrix of_force{}, of_motion{};
  };

  /// Halves a move until it leaves less, and ends linearised there. Where no part does the whole is taken:
  /// the function has kinks.
  void take(const VectorXd& move) {
    const VectorXd from = forces_;
    const double before = left_.norm();
    double part = 1;
    for (int halving = 0; halving < most_halvings; ++halving, part /= 2) {
      forces_ = from + part * move;
      linearise(forces_);
      if (left_.norm() < (1 - least_progress * part) * before)
        return;
    }
    forces_ = from + move;
    linearise(forces_);
  }

  /// Takes away what is left to first order: by the forces that are not pressed first, the others are solved
  /// for. Nothing where these move nothing.
  std::optional<VectorXd> move() const {
    const auto pressed = pressed_points();
    VectorXd move = -left_;
    for (const Index k : pressed)
      std::fill_n(move.data() + k * size_, size_, 0.0);
    const VectorXd carried = linalg::product(cones_.matrix, move);
    VectorXd right(static_cast<Index>(pressed.size()) * size_);
    for (std::size_t i = 0; i < pressed.size(); ++i) {
      const Index k = pressed[i] * size_;
      const auto of_carried = product(slope_of(pressed[i]).of_motion, carried.data() + k);
      for (Index a = 0; a < size_; ++a)
        right[static_cast<Index>(i) * size_ + a] = -left_[k + a] - of_carried[static_cast<std::size_t>(a)];
    }
    const auto lu = linalg::DenseLu::of(slope_between(pressed));
    if (!lu)
      return std::nullopt;
    const VectorXd solved = lu->solve(std::move(right));
    for (std::size_t i = 0; i < pressed.size(); ++i)
      std::copy_n(solved.data() + static_cast<Index>(i) * size_, size_, move.data() + pressed[i] * size_);
    return move;
  }

  std::array<double, 3> product(const PointMatrix& matrix, const double* x) const {
    std::array<double, 3> y{};
    for (Index b = 0; b < size_; ++b)
      for (std::size_t a = 0; a < y.size(); ++a)
        y[a] += matrix[static_cast<std::size_t>(b)][a] * x[b];
    return y;
  }

  std::vector<Index> pressed_points() const {
    std::vector<Index> points;
    for (Index k = 0; k < cones_.friction.size(); ++k)
      if (slope_of(k).pressed)
        points.push_back(k);
    return points;
  }

  MatrixXd slope_between(const std::vector<Index>& points) const {
    const Index size = static_cast<Index>(points.size()) * size_;
    MatrixXd matrix(size, size);
    for (Index j = 0; j < size; ++j) {
      const double* const motion =
          &cones_.matrix(0, points[static_cast<std::size_t>(j / size_)] * size_ + j % size_);
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto block = product(slope_of(points[i]).of_motion, motion + points[i] * size_);
        std::copy_n(block.begin(), size_, &matrix(static_cast<Index>(i) * size_, j));
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      for (Index b = 0; b < size_; ++b)
        for (Index a = 0; a < size_; ++a)
          matrix(static_cast<Index>(i) * size_ + a, static_cast<Index>(i) * size_ + b) +=
              slope_of(points[i]).of_force[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)];
    return matrix;
  }

  /// F − projection and its slope.
  void linearise(const VectorXd& f) {
    motion_ = cones_.values;
    linalg::add_product(cones_.matrix, f, motion_);
    left_ = f;
    for (Index k = 0; k < cones_.friction.size(); ++k)
      subtract_projection(k, f);
  }

  void subtract_projection(Index k, const VectorXd& f) {
    const Index n = k * size_;
    const auto size = static_cast<std::size_t>(size_);
    const double by = augmentation_ / cones_.matrix(n, n);
    const double pressing = f[n] - by * motion_[n];
    auto& slope = slopes_[static_cast<std::size_t>(k)];
    slope.pressed = pressing > 0;
    if (!slope.pressed)
      return;
    left_[n] -= pressing;
    // Of the projection, by F − augmentation w.
    PointMatrix projected{};
    projected[0][0] = 1;
    std::array<double, 3> wanted{}; // along the slips
    double square = 0;
    for (std::size_t a = 1; a < size; ++a) {
      const auto at = n + static_cast<Index>(a);
      wanted[a] = f[at] - by * motion_[at];
      square += wanted[a] * wanted[a];
    }
    const double limit = cones_.friction[k] * pressing;
    const double length = std::sqrt(square);
    if (length < limit) {
      for (std::size_t a = 1; a < size; ++a) {
        left_[n + static_cast<Index>(a)] -= wanted[a];
        projected[a][a] = 1;
      }
    } else if (length > 0) {
      for (std::size_t a = 1; a < size; ++a) {
        const double along = wanted[a] / length;
        left_[n + static_cast<Index>(a)] -= limit * along;
        for (std::size_t b = 1; b < size; ++b)
          projected[b][a] = ((a == b ? 1 : 0) - along * (wanted[b] / length)) * (limit / length);
        projected[0][a] = cones_.friction[k] * along;
      }
    }
    for (std::size_t b = 0; b < size; ++b)
      for (std::size_t a = 0; a < size; ++a) {
        slope.of_force[b][a] = (a == b ? 1 : 0) - projected[b][a];
        slope.of_motion[b][a] = by * projected[b][a];
      }
  }

  const Slope& slope_of(Index k) const { return slopes_[static_cast<std::size_t>(k)]; }

  const FrictionCones& cones_;
  double augmentation_;
  VectorXd forces_;
  Index size_; ///< unknowns of a point
  VectorXd motion_, left_;
  std::vector<Slope> slopes_; ///< by point
};

} // namespace

std::optional<VectorXd> solve_friction(const FrictionCones& cones, const VectorXd& start,
                                       Progress& progress) {
  Iteration near(cones, usual_augmentation, start);
  if (near.run(progress))
    return near.forces();
  Iteration sticking(cones, other_augmentation, linalg::solve_positive_definite(cones.matrix, -cones.values));
  if (sticking.run(progress))
    return sticking.forces();
  return std::nullopt;
}

} // namespace rubato::step
