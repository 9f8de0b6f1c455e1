// SPDX-License-Identifier: LGPL-3.0-or-later
/// The linear system of the points in contact, on a bulk that answers by its surface compliance S.
///
/// Unknowns are (δz, δξ) of each point (contact/factored_response.hpp): the change of its force and of its
/// place on the master. Its own multipliers are eliminated. With C the change of force put on the dofs, f₁
/// the scheme's weight of forces, f_c what contact puts on the surface now, and d₀ − f₁ S f_c how far the
/// surface then moves from where the points were measured:
///   A₁ δz + A₂ δq = b,   δξ − P δq = 0,   δq = d₀ − f₁ S (f_c + Cᵀ (δz, δξ))   at each point.
/// The moving places change little beside the forces, so only the forces' own dense matrix is factored and
/// the whole is refined with it; where that does not converge, the whole is factored.
#pragma once

#include "rubato/contact/factored_response.hpp"
#include "rubato/linalg/dense_lu.hpp"
#include "rubato/step/touched_surface.hpp"

#include <Eigen/Core>
#include <Eigen/QR>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace rubato::step {

/// A point in contact, linearised, its multipliers eliminated.
struct ActivePoint {
  std::size_t zone = 0;
  std::size_t index = 0;
  contact::Status status = contact::Status::open;
  contact::FactoredResponse response;
  std::vector<int> positions; ///< on the surface, of those dofs of the response that no support holds
  Eigen::MatrixXd spread;     ///< N over H there
  Eigen::MatrixXd by_q;       ///< Z_q, E_q, P there
  PointRows rows;             ///< A₂ and N there
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> by_force; ///< A₁
  contact::PointVector right;                                              ///< b
  /// Z_m over E_m, rows and columns scaled to entries of order one, factored.
  Eigen::HouseholderQR<contact::MultiplierColumns> by_multiplier;
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1> row_scale;
  contact::PointVector column_scale;
  Eigen::Index first_slope = 0; ///< of its δξ among those of all points

  Eigen::Index first() const { return rows.first; }
  int components() const { return response.components; }
  int slopes() const { return response.slopes; }
};

class PointSystem {
public:
  /// Both must outlive this.
  PointSystem(Compliance& compliance, TouchedSurface& surface, double force_weight);

  void clear();
  void add(std::size_t zone, std::size_t index, contact::Status status,
           const contact::FactoredResponse& response);
  std::span<const ActivePoint> points() const { return {points_.data(), count_}; }
  /// f_c, one a position [force].
  const Eigen::VectorXd& force() const { return force_; }

  struct Change {
    Eigen::VectorXd force;  ///< δz, point after point
    Eigen::VectorXd places; ///< δξ, point after point
  };
  /// `d0`: one a position. Nothing comes back when the system is singular.
  std::optional<Change> solve(const Eigen::VectorXd& d0);
  /// f_c with a change.
  Eigen::VectorXd force_after(const Change& change) const;
  /// δm of a point, given the whole change and how far the surface moved with it.
  contact::PointVector multipliers_of(const ActivePoint& point, const Change& change,
                                      const Eigen::VectorXd& moved) const;

private:
  void eliminate_multipliers(ActivePoint& point);
  std::span<ActivePoint> active() { return {points_.data(), count_}; }
  void touch_surface();
  bool factor_forces();
  std::optional<Change> refined(const Eigen::VectorXd& c);
  std::optional<Change> solved_whole(const Eigen::VectorXd& c);
  static double force_on(const ActivePoint& point, std::size_t q, const Change& change);
  static void add_places(const ActivePoint& point, const Eigen::VectorXd& d, double* places);
  Eigen::VectorXd motion(const Change& change) const;
  Change residual(const Eigen::VectorXd& c, const Change& change) const;
  Eigen::VectorXd places_after(const Change& change) const;
  Change no_change() const;

  Compliance& compliance_;
  double force_weight_;
  std::vector<ActivePoint> points_; ///< the first count_ of them; others are storage
  std::size_t count_ = 0;
  Eigen::MatrixXd combined_; ///< storage of eliminate_multipliers
  Eigen::VectorXd force_;
  Eigen::Index forces_ = 0; ///< how many δz
  Eigen::Index places_ = 0; ///< how many δξ
  TouchedSurface& surface_;
  std::optional<linalg::DenseLu> factors_;
  Eigen::VectorXd row_scale_, column_scale_; ///< of the factored matrix
};

} // namespace rubato::step
