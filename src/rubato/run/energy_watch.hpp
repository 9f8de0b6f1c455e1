// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is said of a run's energy.
#pragma once

#include "rubato/results/plausibility.hpp"
#include "rubato/run/watch.hpp"
#include "rubato/step/energy_ledger.hpp"

#include <string>
#include <vector>

namespace rubato::run {

/// Follows the ledger of a run: says when energy is gained and not given up again or hourglasses hold much of
/// it, and at the end how well the ledger closes. docs/theory/energy.md has the numbers behind what is worth
/// a warning.
class EnergyWatch {
public:
  /// Everything must outlive this. `record`: of what was followed before; `rubs`: there is friction.
  EnergyWatch(const std::string& run, const Watch& watch, const step::EnergyRecord& record, bool rubs = false)
      : run_(run), watch_(watch), record_(record), rubs_(rubs) {}

  /// `giver`: "contact.z" of the zone whose pressures have given most, or empty.
  void note(double t, const step::EnergyLedger& ledger, const std::string& giver = "");
  /// At the end of the run.
  void tell();
  const step::EnergyRecord& record() const { return record_; }
  /// The gain, the balance of the ledger, energy that friction gave, hourglasses.
  std::vector<results::Plausibility> checks() const;

private:
  void warn(const std::string& when);
  void note_hourglasses(double t);
  void note_friction(double t);

  const std::string& run_;
  const Watch& watch_;
  step::EnergyRecord record_;
  bool rubs_;
  step::EnergyLedger now_;
  std::string giver_;
  double gained_since_ = 0;
  int gained_for_ = 0; ///< instants in a row at which the gain was worth a warning
  bool warned_ = false;
  double most_internal_ = 0; ///< that bodies have stored and dissipated
  double gain_part_ = 0; ///< of the largest energy: gained where it was warned of, else the most below that
  /// What friction had taken at its most, and the most that it gave back from there.
  struct Friction {
    double taken = 0, given = 0; ///< [energy]
    double t = 0;                ///< when it had given most
  } friction_;
  double hourglass_part_ = 0; ///< the most that hourglasses held of what the bodies stored and dissipated
};

} // namespace rubato::run
