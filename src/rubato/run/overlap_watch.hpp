// SPDX-License-Identifier: LGPL-3.0-or-later
/// Says when surfaces have come deep into each other within a step.
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/run/time_loop.hpp"
#include "rubato/step/state.hpp"

namespace rubato::run {

/// A slave point that was in front of its master, or no deeper behind it than half a face, and lies deeper
/// than a whole face after the step: it came too far in one step, or its spring is too soft. Results from
/// there on may be wrong, up to bodies that pass through each other. Said once a run.
class OverlapWatch {
public:
  /// Everything must outlive this.
  OverlapWatch(const model::Model& model, const Watch& watch) : model_(model), watch_(watch) {}

  void note(const step::State& before, const step::State& now);

private:
  const model::Model& model_;
  const Watch& watch_;
  bool warned_ = false;
};

} // namespace rubato::run
