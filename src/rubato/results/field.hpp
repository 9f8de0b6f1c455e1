// SPDX-License-Identifier: LGPL-3.0-or-later
/// A named field of values at the nodes, as result files take it.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace rubato::results {

struct NodalField {
  std::string name;
  int components = 1;
  std::span<const double> values;           ///< node-major, node_count · components; seen, not owned
  std::vector<std::string> component_names; ///< as many as components, or none: then x, y, z or 1, 2, 3…
  std::string unit;                         ///< of every component; may be empty
};

} // namespace rubato::results
