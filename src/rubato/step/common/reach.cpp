// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/reach.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {

double Reach::part_of(const Eigen::VectorXd& move, double more) {
  if (!std::isfinite(most_) || move.size() == 0)
    return 1;
  const double largest = move.lpNorm<Eigen::Infinity>();
  if (last_.size() == move.size())
    allowed_ = last_.dot(move) < 0 ? allowed_ / 2 : std::min(2 * allowed_, most_);
  const double limit = allowed_ + more;
  const double part = largest <= limit ? 1 : limit / largest;
  last_ = part * move;
  return part;
}

} // namespace rubato::step
