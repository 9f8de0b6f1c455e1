// SPDX-License-Identifier: LGPL-3.0-or-later
/// The watches of a run: each looks at its steps for one kind of wrong result.
#pragma once

#include "rubato/results/plausibility.hpp"
#include "rubato/run/balance_watch.hpp"
#include "rubato/run/contact_work_watch.hpp"
#include "rubato/run/energy_watch.hpp"
#include "rubato/run/overlap_watch.hpp"
#include "rubato/run/pressure_watch.hpp"
#include "rubato/run/recall_watch.hpp"
#include "rubato/run/spring_watch.hpp"
#include "rubato/run/strain_watch.hpp"
#include "rubato/run/turn_watch.hpp"
#include "rubato/run/wave_watch.hpp"

#include <vector>

namespace rubato::run {

/// Warnings of single watches come in their step, checks of the whole run at its end.
class Watches {
public:
  /// Everything must outlive this. `record`, `former`: of the run before it was resumed, or none.
  Watches(const model::Model& model, const Watch& watch, const step::EnergyRecord& record,
          std::vector<results::Plausibility> former);

  /// Takes an accepted step; `told`: its end as results have it.
  void note(const step::State& before, const step::State& now, const step::State& told,
            const step::EnergyLedger& ledger, bool last);
  /// Takes the energy of a committed step.
  void note_energy(double t, const step::EnergyLedger& ledger);
  const step::EnergyRecord& energy() const { return energy_.record(); }
  /// The checks of the run so far, with its parts before it was resumed.
  std::vector<results::Plausibility> checks() const;
  /// At the end of the run: warns of what only the whole run shows, and of checks that do not pass and that
  /// nothing has warned of. The checks.
  std::vector<results::Plausibility> tell();

private:
  bool is_sampled(double before, double now, bool last) const;

  const model::Model& model_;
  const Watch& watch_;
  std::vector<results::Plausibility> former_; ///< and what is known before the first step
  EnergyWatch energy_;
  OverlapWatch overlaps_;
  RecallWatch recall_;
  TurnWatch turns_;
  StrainWatch strains_;
  SpringWatch springs_;
  BalanceWatch balance_;
  ContactWorkWatch work_;
  PressureWatch pressures_;
  WaveWatch waves_;
};

} // namespace rubato::run
