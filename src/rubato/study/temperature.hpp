// SPDX-License-Identifier: LGPL-3.0-or-later
/// Temperatures that bodies have, and how they expand by them.
#pragma once

#include "rubato/study/values.hpp"

#include <array>
#include <string>

namespace rubato::study {

/// Strains α (T − reference) of a material that nothing stresses.
struct ThermalExpansion {
  /// α along the axes x', y', z' of the material [1/temperature]; elastic materials have one α.
  std::array<double, 3> along{};
  double reference = 0; ///< temperature at which nothing is expanded
  bool operator==(const ThermalExpansion&) const = default;
};

/// The temperature of the nodes of a group, a node, or "all". Where entries share nodes, the last one counts.
struct Temperature {
  std::string on;
  Field value;
  bool operator==(const Temperature&) const = default;
};

} // namespace rubato::study
