// SPDX-License-Identifier: LGPL-3.0-or-later
/// The compliance of the interface, restricted to the surface unknowns of active contact points: the blocks
/// C_i S C_jᵀ between points are taken from it, body by body.
#pragma once

#include "rubato/step/compliance.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::step {

class ActiveInterfaceCompliance {
public:
  /// `compliance` must outlive this.
  explicit ActiveInterfaceCompliance(Compliance& compliance) : compliance_(&compliance) {}

  void forget();
  /// Takes these positions too, each of which may occur several times; they have places after touch_added.
  void add(std::span<const int> positions);
  /// Gives every position added a place. Places change when there are new ones.
  void touch_added();
  Eigen::Index size() const { return static_cast<Eigen::Index>(positions_.size()); }
  /// The position of every place.
  const std::vector<int>& positions() const { return positions_; }
  int place_of(int position) const { return places_[static_cast<std::size_t>(position)]; }

  /// moved = S force, both one a place.
  void multiply(const Eigen::VectorXd& force, Eigen::VectorXd& moved) const;
  /// moved += S force, one a place, with the force given by its entries at some places.
  void add_motion(std::span<const int> places,
                  const Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>& force,
                  double* moved) const;

private:
  struct Body {
    Eigen::Index first = 0; ///< of its places
    Eigen::MatrixXd s;
  };
  Compliance* compliance_;
  std::vector<int> positions_;
  std::size_t placed_ = 0;   ///< how many positions have a place
  std::vector<int> places_;  ///< by position, −1 where nothing touches
  std::vector<int> body_of_; ///< by place
  std::vector<Body> bodies_;
};

/// A contact point's forces and equations over places: forces F (one a row) put rightᵀ F there, and its
/// equations see left · d.
struct PointRows {
  std::vector<int> places;
  Eigen::MatrixXd left;
  Eigen::MatrixXd right;

  /// Adds rows of zeros up to this many.
  void fill_up(Eigen::Index rows);
};

/// S rightᵀ of a point's first `rows` rows, at most five: how unit forces in them move the places.
Eigen::MatrixXd moved_by(const ActiveInterfaceCompliance& surface, const PointRows& point, Eigen::Index rows);

/// factor · left S rightᵀ between all points, of the first `rows` rows of each, at most five.
Eigen::MatrixXd between_points(const ActiveInterfaceCompliance& surface,
                               std::span<const PointRows* const> points, Eigen::Index rows, double factor);

} // namespace rubato::step
