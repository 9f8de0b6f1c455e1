// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/active_set.hpp"

#include "rubato/linalg/dense_cholesky.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Part of the largest value that rounding makes of zero.
constexpr double rounding = 1e-12;
/// Rounds a solution takes at most, in unknowns.
constexpr Index most_rounds = 3;

class ActiveSet {
public:
  ActiveSet(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces)
      : matrix_(matrix), values_(values), forces_(forces) {
    for (Index k = 0; k < forces.size(); ++k)
      if (forces[k] > 0 && matrix(k, k) > 0)
        set_.push_back(k);
      else
        forces[k] = 0;
  }

  bool run(Pulse& pulse) {
    const Index most = 2 * most_rounds * (forces_.size() + 1);
    for (Index round = 0; round < most && pulse.beat(); ++round) {
      const VectorXd wanted = wanted_forces();
      if (!wanted.allFinite())
        return false;
      if (!approach(wanted))
        continue;
      if (!join_most_violated())
        return true;
    }
    return false;
  }

private:
  /// Of the set, without a bound.
  VectorXd wanted_forces() const {
    MatrixXd among = matrix_(set_, set_);
    return linalg::solve_positive_definite(std::move(among), VectorXd(-values_(set_)));
  }

  /// Goes there as far as no force pulls. Whether that is all the way; else what has come to zero leaves.
  bool approach(const VectorXd& wanted) {
    double part = 1;
    for (std::size_t k = 0; k < set_.size(); ++k)
      if (const double now = forces_[set_[k]], then = wanted[static_cast<Index>(k)]; then < 0)
        part = std::min(part, now / (now - then));
    for (std::size_t k = 0; k < set_.size(); ++k) {
      const double now = forces_[set_[k]];
      const double then = wanted[static_cast<Index>(k)];
      const bool leaves = then < 0 && now <= part * (now - then);
      forces_[set_[k]] = leaves ? 0.0 : std::max(0.0, now + part * (then - now));
    }
    if (part == 1)
      return true;
    std::erase_if(set_, [&](Index k) { return forces_[k] == 0; });
    return false;
  }

  bool join_most_violated() {
    VectorXd open = values_;
    open.noalias() += matrix_ * forces_;
    open(set_).setZero();
    Index worst = -1;
    double least = -rounding * values_.lpNorm<Eigen::Infinity>();
    for (Index k = 0; k < open.size(); ++k)
      if (matrix_(k, k) > 0 && open[k] < least) {
        least = open[k];
        worst = k;
      }
    if (worst >= 0)
      set_.push_back(worst);
    return worst >= 0;
  }

  const MatrixXd& matrix_;
  const VectorXd& values_;
  VectorXd& forces_;
  std::vector<Index> set_;
};

} // namespace

bool solve_complementarity(const MatrixXd& matrix, const VectorXd& values, VectorXd& forces, Pulse& pulse) {
  return ActiveSet(matrix, values, forces).run(pulse);
}

} // namespace rubato::step
