// SPDX-License-Identifier: LGPL-3.0-or-later
/// Says when steps are too long for back stresses that recall.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/run/watch.hpp"
#include "rubato/step/state.hpp"

namespace rubato::run {

/// Armstrong and Frederick's rule, dα = dε^p − γ α dp, is integrated to first order in the step: with γ Δp
/// above a tenth stresses are some percent off. Said once a run.
class RecallWatch {
public:
  /// Everything must outlive this.
  RecallWatch(const model::Model& model, const Watch& watch);

  void note(const step::State& before, const step::State& now);

private:
  const model::Model& model_;
  const Watch& watch_;
  double recall_ = 0; ///< the largest γ of implicit runs; 0: nothing to watch
};

} // namespace rubato::run
