// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/newton_history.hpp"

#include <Eigen/QR>

#include <cstddef>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Iterates that are remembered: few directions converge slowly.
constexpr std::size_t most_entries = 6;
constexpr double slow = 0.1;
/// Differences that depend on one another to that part are not told apart.
constexpr double dependent = 1e-6;

} // namespace

void Corrected::add(double share, const Corrected& to, const Corrected& from) {
  applied += share * (to.applied - from.applied);
  for (std::size_t z = 0; z < multipliers.size(); ++z)
    multipliers[z] += share * (to.multipliers[z] - from.multipliers[z]);
}

void NewtonHistory::forget() {
  entries_.clear();
}

void NewtonHistory::add(VectorXd change, const Corrected& corrected) {
  if (entries_.size() == most_entries)
    entries_.erase(entries_.begin());
  entries_.push_back({std::move(change), corrected});
}

bool NewtonHistory::is_slow() const {
  const auto count = entries_.size();
  return count >= 2 && entries_[count - 1].change.norm() > slow * entries_[count - 2].change.norm();
}

void NewtonHistory::accelerate(Corrected& correction) const {
  const auto count = static_cast<Index>(entries_.size()) - 1;
  const auto& last = entries_.back();
  MatrixXd differences(last.change.size(), count);
  for (Index j = 0; j < count; ++j)
    differences.col(j) =
        entries_[static_cast<std::size_t>(j) + 1].change - entries_[static_cast<std::size_t>(j)].change;
  Eigen::ColPivHouseholderQR<MatrixXd> factor;
  factor.setThreshold(dependent);
  factor.compute(differences);
  const VectorXd shares = factor.solve(last.change);
  if (!shares.allFinite())
    return;
  for (Index j = 0; j < count; ++j)
    correction.add(-shares[j], entries_[static_cast<std::size_t>(j) + 1].corrected,
                   entries_[static_cast<std::size_t>(j)].corrected);
}

} // namespace rubato::step
