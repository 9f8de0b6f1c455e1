// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/newton_history.hpp"

#include "rubato/linalg/pivoted_qr.hpp"

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

} // namespace

void Corrected::add(double share, const Corrected& to, const Corrected& from) {
  applied += share * (to.applied - from.applied);
  for (std::size_t z = 0; z < multipliers.size(); ++z)
    multipliers[z] += share * (to.multipliers[z] - from.multipliers[z]);
}

std::vector<double> shares_of_history(std::span<const VectorXd> changes) {
  const auto count = changes.size() - 1;
  MatrixXd differences(changes.back().size(), static_cast<Index>(count));
  for (std::size_t j = 0; j < count; ++j)
    differences.col(static_cast<Index>(j)) = changes[j + 1] - changes[j];
  const VectorXd shares = linalg::PivotedQr(std::move(differences)).solve(changes.back());
  return shares.allFinite() ? std::vector<double>(shares.begin(), shares.end()) : std::vector<double>{};
}

void NewtonHistory::forget() {
  changes_.clear();
  corrected_.clear();
}

void NewtonHistory::add(VectorXd change, const Corrected& corrected) {
  if (changes_.size() == most_entries) {
    changes_.erase(changes_.begin());
    corrected_.erase(corrected_.begin());
  }
  changes_.push_back(std::move(change));
  corrected_.push_back(corrected);
}

bool NewtonHistory::is_slow() const {
  const auto count = changes_.size();
  return count >= 2 && changes_[count - 1].norm() > slow * changes_[count - 2].norm();
}

void NewtonHistory::accelerate(Corrected& correction) const {
  const auto shares = shares_of_history(changes_);
  for (std::size_t j = 0; j < shares.size(); ++j)
    correction.add(-shares[j], corrected_[j + 1], corrected_[j]);
}

} // namespace rubato::step
