// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/friction_cones.hpp"

#include "rubato/linalg/dense_decompositions.hpp"

#include <utility>

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
constexpr double augmentation = 10;

/// Newton's method on F = projection of F − augmentation w, friction's limit following the pressing force.
class Iteration {
public:
  Iteration(const FrictionCones& cones, VectorXd forces)
      : cones_(cones), forces_(std::move(forces)), size_(forces_.size() / cones.friction.size()) {}

  bool run(Pulse& pulse) {
    linearise(forces_);
    for (int round = 0; round < most_newton_steps && pulse.beat() && left_.allFinite(); ++round) {
      if (left_.lpNorm<Eigen::Infinity>() <= tolerance * forces_.lpNorm<Eigen::Infinity>()) {
        forces_ -= left_;
        return true;
      }
      take(linalg::solve_square(slope_, -left_));
    }
    return false;
  }

  const VectorXd& forces() const { return forces_; }

private:
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

  /// F − projection and its slope.
  void linearise(const VectorXd& f) {
    motion_ = cones_.values + cones_.matrix * f;
    left_ = f;
    slope_ = MatrixXd::Identity(f.size(), f.size());
    for (Index k = 0; k < cones_.friction.size(); ++k)
      subtract_projection(k, f);
  }

  void subtract_projection(Index k, const VectorXd& f) {
    const Index n = k * size_;
    const Index t = n + 1;
    const Index tangents = size_ - 1;
    const double by = augmentation / cones_.matrix(n, n);
    const double pressed = f[n] - by * motion_[n];
    if (pressed <= 0)
      return;
    Eigen::RowVectorXd pressing = -by * cones_.matrix.row(n);
    pressing[n] += 1;
    left_[n] -= pressed;
    slope_.row(n) -= pressing;
    const VectorXd wanted = f.segment(t, tangents) - by * motion_.segment(t, tangents);
    MatrixXd rubbing = -by * cones_.matrix.middleRows(t, tangents);
    rubbing.middleCols(t, tangents).diagonal().array() += 1;
    const double limit = cones_.friction[k] * pressed;
    const double length = wanted.norm();
    if (length < limit) {
      left_.segment(t, tangents) -= wanted;
      slope_.middleRows(t, tangents) -= rubbing;
    } else if (length > 0) {
      const VectorXd along = wanted / length;
      left_.segment(t, tangents) -= limit * along;
      slope_.middleRows(t, tangents) -= limit / length * (rubbing - along * (along.transpose() * rubbing)) +
                                        cones_.friction[k] * along * pressing;
    }
  }

  const FrictionCones& cones_;
  VectorXd forces_;
  Index size_; ///< unknowns of a point
  VectorXd motion_, left_;
  MatrixXd slope_;
};

} // namespace

std::optional<VectorXd> solve_friction(const FrictionCones& cones, const VectorXd& start, Pulse& pulse) {
  Iteration near(cones, start);
  if (near.run(pulse))
    return near.forces();
  Iteration sticking(cones, -linalg::solve_square(cones.matrix, cones.values));
  if (sticking.run(pulse))
    return sticking.forces();
  return std::nullopt;
}

} // namespace rubato::step
