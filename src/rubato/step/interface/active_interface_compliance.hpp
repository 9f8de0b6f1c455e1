// SPDX-License-Identifier: LGPL-3.0-or-later
/// The compliance of the interface, restricted to the surface unknowns of active contact points: the blocks
/// C_i S C_jᵀ between points are taken from it, body by body.
#pragma once

#include "rubato/step/interface/compliance.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::step {

class ActiveInterfaceCompliance {
public:
  /// `compliance` must outlive this.
  explicit ActiveInterfaceCompliance(Compliance& compliance) : compliance_(&compliance) {}

  void forget();
  /// Takes these interface dofs too, each of which may occur several times; touch_added makes them active.
  void add(std::span<const int> interface_dofs);
  /// Numbers every interface dof added; the numbers of active dofs change when there are new ones. S between
  /// them is formed.
  void touch_added();
  /// The same without S: `multiply` then asks the whole surface, and `add_motion` is not there.
  void number_added();
  Eigen::Index size() const { return static_cast<Eigen::Index>(interface_dofs_.size()); }
  /// The interface dof of every active dof.
  const std::vector<int>& interface_dofs() const { return interface_dofs_; }
  int active_dof_of(int interface_dof) const {
    return active_dof_of_[static_cast<std::size_t>(interface_dof)];
  }

  const Threads& threads() const { return compliance_->threads(); }

  /// moved = S force, both one an active dof.
  void multiply(const Eigen::VectorXd& force, Eigen::VectorXd& moved) const;
  /// moved += S force, one an active dof, with the force given by its entries at some active dofs.
  void add_motion(std::span<const int> active_dofs,
                  const Eigen::Ref<const Eigen::RowVectorXd, 0, Eigen::InnerStride<>>& force,
                  double* moved) const;

private:
  void multiply_by_surface(const Eigen::VectorXd& force, Eigen::VectorXd& moved) const;

  struct Body {
    Eigen::Index first = 0; ///< of its active dofs
    Eigen::MatrixXd s;
  };
  Compliance* compliance_;
  std::vector<int> interface_dofs_;
  std::size_t numbered_ = 0;       ///< how many are numbered
  bool formed_ = false;            ///< whether S between these is there
  std::vector<int> active_dof_of_; ///< by interface dof, −1 where nothing touches
  std::vector<int> body_of_;       ///< by active dof
  std::vector<Body> bodies_;       ///< those with active dofs
};

/// A contact point's forces and equations over active dofs: forces F (one a row) put rightᵀ F there, and its
/// equations see left · d.
struct PointRows {
  std::vector<int> active_dofs;
  Eigen::MatrixXd left;
  Eigen::MatrixXd right;

  /// Adds rows of zeros up to this many.
  void fill_up(Eigen::Index rows);
};

/// S rightᵀ of a point's first `rows` rows, at most five: how unit forces in them move the active dofs.
Eigen::MatrixXd moved_by(const ActiveInterfaceCompliance& surface, const PointRows& point, Eigen::Index rows);

/// factor · left S rightᵀ between all points, of the first `rows` rows of each, at most five.
Eigen::MatrixXd between_points(const ActiveInterfaceCompliance& surface,
                               std::span<const PointRows* const> points, Eigen::Index rows, double factor);

} // namespace rubato::step
