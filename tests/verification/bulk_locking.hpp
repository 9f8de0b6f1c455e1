// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies that bend and that keep their volume, with every formulation of linear cells: Cook's membrane
/// (R. D. Cook, J. Struct. Div. ASCE 100 (1974) 1851–1863), a thick tube under pressure, a cantilever.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rubato::verification {

/// What one formulation gives.
struct LockingNumber {
  double found = 0;
  double expected = 0; ///< of an independent prototype of the same formulation
  double digit = 0;    ///< the last one that `expected` is known to
};

/// One structure on one mesh.
struct LockingRow {
  std::string what;
  double exact = 0;                                             ///< or converged
  std::optional<LockingNumber> full, mean_dilatation, enhanced; ///< where the cells have it
};

/// Whether it is within 0.5 % of what is expected, or as near as its digits tell, or nearer to `exact`.
bool holds(const LockingNumber& number, double exact);

/// Membranes of more cells a side than `finest` are left out.
std::vector<LockingRow> locking_rows(int finest = 128);

} // namespace rubato::verification
