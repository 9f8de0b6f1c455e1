// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whether contact pressures of static runs act along the gaps that they close.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/state.hpp"

#include <string>
#include <vector>

namespace rubato::run {

/// A normal force N that acts along the gap g takes −½ (N₀ + N₁)(g₁ − g₀) in a step from 0 to 1, with the
/// mean of both ends as the ledger's `impact` has it. What `impact` has beyond the sum of these is work of
/// forces across their gaps: a drag or a pull without friction, or turns in a step that is too long.
class ContactWorkWatch {
public:
  /// The model must outlive this.
  explicit ContactWorkWatch(const model::Model& model);

  void note(const step::State& before, const step::State& now, const step::EnergyLedger& ledger);
  /// "contact.z" of the zone whose pressures have given most along its gaps so far; empty where none has.
  std::string giver() const;
  /// The check of a static run whose contact is exact; none of other runs, nor where obstacles or gaps move
  /// by themselves.
  std::vector<results::Plausibility> checks() const;

private:
  const model::Model& model_;
  bool applies_ = false;
  std::vector<double> along_gaps_; ///< taken so far, by zone [force · length]
  double taken_before_ = 0;        ///< across gaps, by the end of the first step of a run that is resumed
  double across_ = 0;              ///< the largest magnitude [force · length]
  double largest_ = 0;             ///< energy [force · length]
  double t_ = 0;
  bool first_ = true;
};

} // namespace rubato::run
