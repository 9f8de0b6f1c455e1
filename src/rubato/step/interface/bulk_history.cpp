// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/bulk_history.hpp"

#include "rubato/step/interface/newton_history.hpp"

#include <cstddef>
#include <utility>

namespace rubato::step {
namespace {

/// Iterates that are remembered, each of which is as large as a state.
constexpr std::size_t most_iterates = 5;
/// Part of the move before that Newton's iterations stay below.
constexpr double slow_move = 0.2;
/// Cosine between moves that go on in one direction.
constexpr double straight = 0.9;

} // namespace

void BulkIterate::add(double share, const BulkIterate& to, const BulkIterate& from) {
  motion.u += share * (to.motion.u - from.motion.u);
  motion.v += share * (to.motion.v - from.motion.v);
  motion.a += share * (to.motion.a - from.motion.a);
  force.add(share, to.force, from.force);
  for (std::size_t z = 0; z < multipliers.size(); ++z)
    multipliers[z] += share * (to.multipliers[z] - from.multipliers[z]);
}

void BulkHistory::forget() {
  moves_.clear();
  iterates_.clear();
}

void BulkHistory::add(const time::Motion& base, BulkIterate reached,
                      const std::vector<std::vector<contact::Status>>& status) {
  if (status != status_)
    forget();
  status_ = status;
  if (iterates_.size() == most_iterates) {
    moves_.erase(moves_.begin());
    iterates_.erase(iterates_.begin());
  }
  moves_.push_back(reached.motion.u - base.u);
  iterates_.push_back(std::move(reached));
}

bool BulkHistory::is_slow() const {
  const auto count = moves_.size();
  return count >= 2 && moves_[count - 1].norm() > slow_move * moves_[count - 2].norm();
}

bool BulkHistory::is_steadily_slow() const {
  const auto count = moves_.size();
  if (!is_slow())
    return false;
  const auto& last = moves_[count - 1];
  const auto& before = moves_[count - 2];
  if (last.dot(before) > straight * last.norm() * before.norm())
    return true;
  return count >= 3 && last.norm() < before.norm() && before.norm() < moves_[count - 3].norm() &&
         before.norm() > slow_move * moves_[count - 3].norm();
}

BulkIterate BulkHistory::accelerated() const {
  auto iterate = iterates_.back();
  const auto shares = shares_of_history(moves_);
  for (std::size_t j = 0; j < shares.size(); ++j)
    iterate.add(-shares[j], iterates_[j + 1], iterates_[j]);
  return iterate;
}

} // namespace rubato::step
