// SPDX-License-Identifier: LGPL-3.0-or-later
/// What every time loop counts by.
#pragma once

#include "rubato/step/state.hpp"

#include <algorithm>
#include <ctime>

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

} // namespace rubato::run
