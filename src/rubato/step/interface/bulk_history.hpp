// SPDX-License-Identifier: LGPL-3.0-or-later
/// Iterates of a nonlinear bulk, accelerated by their own history as those of contact are
/// (newton_history.hpp). A matrix with springs that the tangent has not holds surfaces back that move on, and
/// iterations go along few directions slowly.
#pragma once

#include "rubato/contact/law.hpp"
#include "rubato/step/common/equilibrium.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::step {

/// A motion of the whole bulk with contact solved to its end.
struct BulkIterate {
  time::Motion motion;
  ContactForce force;
  std::vector<Eigen::VectorXd> multipliers; ///< of each zone

  /// Adds share · (to − from).
  void add(double share, const BulkIterate& to, const BulkIterate& from);
};

class BulkHistory {
public:
  void forget();
  /// What was reached from a base, with the statuses of each zone's points. Iterates with others are
  /// forgotten.
  void add(const time::Motion& base, BulkIterate reached,
           const std::vector<std::vector<contact::Status>>& status);
  /// Whether the last move is more than a part of the one before.
  bool is_slow() const;
  /// Whether it also goes on in the direction of the one before, or that one was slow already and both got
  /// shorter: Newton's method may well have a long move before it converges.
  bool is_steadily_slow() const;
  /// The last iterate combined with those before.
  BulkIterate accelerated() const;

private:
  std::vector<Eigen::VectorXd> moves_; ///< of the displacements, from base to iterate
  std::vector<BulkIterate> iterates_;
  std::vector<std::vector<contact::Status>> status_;
};

} // namespace rubato::step
