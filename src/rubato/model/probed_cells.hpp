// SPDX-License-Identifier: LGPL-3.0-or-later
/// Cells that probes evaluate.
#pragma once

#include <cstddef>
#include <vector>

namespace rubato::model {

/// Cells that a probe has values of, by their places in the bulk.
struct ProbedCells {
  std::vector<std::size_t> cells;
  int point = -1; ///< the Gauss point of the one cell; −1: every point of each
};

} // namespace rubato::model
