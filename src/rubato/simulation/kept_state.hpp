// SPDX-License-Identifier: LGPL-3.0-or-later
/// The state of a simulation, which others may hold while steps go on.
#pragma once

#include "rubato/step/state.hpp"

#include <atomic>
#include <memory>
#include <utility>

namespace rubato::simulation {

class KeptState {
public:
  explicit KeptState(step::State state) : state_(std::make_shared<step::State>(std::move(state))) {}

  const step::State& operator*() const { return *state_; }
  const step::State* operator->() const { return state_.get(); }
  /// To hold: what it points to does not change any more.
  std::shared_ptr<const step::State> shared() const { return state_; }

  /// To change: a copy where others hold the state.
  step::State& changeable() {
    if (is_held())
      state_ = std::make_shared<step::State>(*state_);
    return *state_;
  }

  /// Takes another state's place. Gives back the one before, for its storage; an empty one where others hold
  /// it.
  step::State replace(step::State next) {
    if (!is_held())
      return std::exchange(*state_, std::move(next));
    state_ = std::make_shared<step::State>(std::move(next));
    return {};
  }

private:
  bool is_held() const {
    if (state_.use_count() > 1)
      return true;
    // Whoever held it may have been another thread, which must have read before this one writes.
    std::atomic_thread_fence(std::memory_order_acquire);
    return false;
  }

  std::shared_ptr<step::State> state_; ///< there is one
};

} // namespace rubato::simulation
