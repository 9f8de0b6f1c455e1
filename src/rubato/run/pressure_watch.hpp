// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far contact points that touch are from being closed, settled and smooth.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/state.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rubato::run {

/// Looks at the points of exact zones in every step, at pressures of nodes beside one another where asked.
class PressureWatch {
public:
  /// The model must outlive this.
  explicit PressureWatch(const model::Model& model);

  /// Gaps and statuses, in every step.
  void note(const step::State& before, const step::State& now, const step::EnergyLedger& ledger);
  /// Pressures of neighbours; costs more.
  void note_pressures(const step::State& now);
  std::vector<results::Plausibility> checks() const;

private:
  struct Worst {
    double value = 0;
    double t = 0;
    std::size_t zone = 0;
    mesh::NodeIndex node = -1;
  };

  std::string place_of(const Worst& worst) const;

  const model::Model& model_;
  std::vector<std::vector<std::uint16_t>> changes_;   ///< by zone and point: steps in a row that changed it
  std::vector<std::vector<std::vector<int>>> around_; ///< by zone: neighbours of each slave node, by position
  Worst gap_; ///< ½ Σ N |g| of the points that press [force · length]
  Worst changing_, oscillation_;
  double most_in_bodies_ = 0; ///< largest strain energy
  bool any_exact_ = false;
};

} // namespace rubato::run
