// SPDX-License-Identifier: LGPL-3.0-or-later
/// In which order a factor that ranks hold together eliminates its unknowns.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/linalg/direct_solver.hpp"

#include <span>
#include <vector>

namespace rubato::linalg {

/// The place of each unknown: nested dissection (METIS) of all but those of the surface, which are last, as
/// they are given. On the first rank; others get nothing. `part`: of this rank (ranked_matrix.hpp),
/// compressed.
std::vector<int> order_of_elimination(const SparseMatrix& part, std::span<const int> surface,
                                      const Ranks& ranks);

} // namespace rubato::linalg
