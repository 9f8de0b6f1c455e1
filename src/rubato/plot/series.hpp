// SPDX-License-Identifier: LGPL-3.0-or-later
/// The columns of a run's tables over time.
#pragma once

#include "rubato/study/study.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rubato::plot {

struct Series {
  std::string name;       ///< "tip.y", "energy.friction", "interface.normal"
  std::string group = {}; ///< the probe of a component, "tip"; else empty
  std::string kind = {};  ///< "displacement [length]"
  bool is_probe = false;
  std::vector<double> t = {};
  std::vector<double> values = {}; ///< one an instant
};

/// Every column of probes.csv, energy.csv and the resultants_ZONE.csv of a run's folder, in that order.
/// Throws InputError when one of these cannot be read.
std::vector<Series> all_series(const std::filesystem::path& run, const study::Study& study);

} // namespace rubato::plot
