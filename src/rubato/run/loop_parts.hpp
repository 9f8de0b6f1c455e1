// SPDX-License-Identifier: LGPL-3.0-or-later
/// What every time loop counts by.
#pragma once

#include "rubato/run/time_loop.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/state.hpp"

#include <algorithm>
#include <ctime>
#include <string>

namespace rubato::run {

inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

inline int points_in_contact(const step::State& state) {
  int count = 0;
  for (const auto& zone : state.zones)
    count += static_cast<int>(
        std::ranges::count_if(zone.status, [](auto status) { return status != contact::Status::open; }));
  return count;
}

/// Follows the ledger of a run: says at once when energy is gained, and at the end how well it closes.
class EnergyWatch {
public:
  /// Everything must outlive this. `record`: of what was followed before.
  EnergyWatch(const std::string& run, const Watch& watch, const step::EnergyRecord& record)
      : run_(run), watch_(watch), record_(record), warned_(gains()) {}

  void note(double t, const step::EnergyLedger& ledger);
  void tell() const;
  const step::EnergyRecord& record() const { return record_; }

private:
  bool gains() const;

  const std::string& run_;
  const Watch& watch_;
  step::EnergyRecord record_;
  bool warned_;
};

} // namespace rubato::run
