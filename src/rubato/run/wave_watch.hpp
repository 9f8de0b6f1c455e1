// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whether steps and cells resolve the vibration of a run.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/step/state.hpp"

#include <vector>

namespace rubato::run {

/// ω² = Σ h |Δv/h|² / Σ h |v|² over the steps, |v|² = vᵀMv, is the mean square frequency of a motion,
/// weighted by its kinetic energy, as far as steps can show it: at most (2/h)². Flight as a rigid body lowers
/// it. Steps are compared with 2π/ω, edges of cells with the length of shear waves, 2π c/ω.
class WaveWatch {
public:
  /// The model must outlive this.
  explicit WaveWatch(const model::Model& model);

  void note(const step::State& before, const step::State& now);
  /// The checks of a dynamic run, none of a static one. Values are 0 where kinetic energy is small beside the
  /// largest energy.
  std::vector<results::Plausibility> checks(double largest_energy) const;

private:
  const model::Model& model_;
  double passage_ = 0; ///< the longest that a shear wave takes through a cell [time]
  double accelerations_ = 0, velocities_ = 0, longest_step_ = 0;
  double begin_ = 0, t_ = 0;
};

} // namespace rubato::run
