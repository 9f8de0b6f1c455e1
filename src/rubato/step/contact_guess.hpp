// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which points will touch, stick and slip at the end of a step, and how hard: a start for Newton's
/// iterations, which from the free motion would let go of one row of points after the other.
#pragma once

#include "rubato/step/touched_surface.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::step {

/// A point that may touch, linearised: its gap and slips are `value` + slopes · d at its positions of the
/// surface, and its forces F along them put −slopesᵀ F there (internal side).
struct GuessPoint {
  std::size_t zone = 0;
  std::size_t index = 0; ///< in the zone's points
  std::vector<int> positions;
  Eigen::MatrixXd slopes;                          ///< of the gap, then of each slip that counts
  Eigen::Vector3d value = Eigen::Vector3d::Zero(); ///< where d = 0 [length]
  Eigen::Vector3d force = Eigen::Vector3d::Zero(); ///< pressing ≥ 0, and along the slips [force]
  double softness = 0; ///< penetration a unit of force makes: of penalties [length/force]
  double friction = 0; ///< μ

  int tangents() const { return static_cast<int>(slopes.rows()) - 1; }
};

class ContactGuess {
public:
  /// The surface moves by d = free + factor S Σ slopesᵀ F. Both must outlive this.
  ContactGuess(Compliance& compliance, TouchedSurface& surface, double factor);

  /// Improves the forces of the points: first the pressing ones, so that no gap is negative, then those along
  /// the slips for the pressing ones found, so that none exceeds μ times them and slips go against them
  /// (Tresca's problem). Points that have no force and don't penetrate get none. Both by projected
  /// Gauss–Seidel sweeps, then by active sets. What the points do to one another is taken over from the last
  /// call while the same points may touch: a guess needs no better.
  void improve(std::span<GuessPoint> points, const Eigen::VectorXd& free);

  /// How much a sweep would change the forces now that the points have been linearised anew and the surface
  /// is at d, in parts of the largest one. The points must be those of the last call.
  double misfit(std::span<const GuessPoint> points, const Eigen::VectorXd& d) const;
  /// Points and what they do to one another.
  void forget();

private:
  /// What forces along some of their rows do to the gaps or slips of points, kept from call to call.
  struct Coupling {
    struct Name {
      std::size_t zone = 0;
      std::size_t index = 0;
      bool operator==(const Name&) const = default;
    };
    std::vector<Name> points;
    Eigen::MatrixXd matrix;
  };
  Eigen::VectorXd moved(std::span<const GuessPoint> points, const Eigen::VectorXd& free, int first_row,
                        int last_row) const;
  bool choose_more(std::span<GuessPoint> points, const Eigen::VectorXd& free);
  void couple(std::span<GuessPoint* const> points, Eigen::Index first_row, Eigen::Index rows,
              Coupling& coupling);
  void press(const Eigen::VectorXd& without);
  void rub(std::span<GuessPoint> points, const Eigen::VectorXd& free);

  Compliance& compliance_;
  TouchedSurface& surface_;
  double factor_;
  std::vector<GuessPoint*> chosen_, sliding_;
  Coupling pressing_, rubbing_;
  std::vector<PointRows> rows_; ///< storage of couple
};

/// Sweeps on w = values + matrix F,  F ≥ 0, w ≥ 0, F·w = 0, until one changes neither which F are positive
/// nor any of them by more than a hundredth of the largest. The matrix is symmetric with a positive diagonal.
void sweep_pressing(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values, Eigen::VectorXd& forces);

/// Sweeps on the minimum of F·values + F·matrix F/2, the forces of a point (`tangents` in a row) no longer
/// than its limit, likewise.
void sweep_rubbing(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& values,
                   const Eigen::VectorXd& limits, int tangents, Eigen::VectorXd& forces);

} // namespace rubato::step
