// SPDX-License-Identifier: LGPL-3.0-or-later
/// States that ranks share, as any one of them can tell, keep and resume them.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"

#include <optional>

namespace rubato::step {

/// A state with what the cells of all ranks remember, and with its internal forces at its instant
/// (BulkForces::internal); the state itself where this process has all cells. Made by all ranks together.
class ToldState {
public:
  /// `state` must outlive this.
  ToldState(const model::Model& model, const State& state);

  const State& operator*() const { return whole_ ? *whole_ : *state_; }

private:
  const State* state_;
  std::optional<State> whole_;
};

/// A state as a file keeps it, whatever the number of ranks: with the tangent and the records of the whole.
/// Called by all ranks together, as the next one.
State kept_state(const model::Model& model, const State& state);
/// Of such a state what this rank goes on with.
State resumed_state(const model::Model& model, State kept);

} // namespace rubato::step
