// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the materials of a bulk remember when ranks share its cells: each rank keeps the states and records
/// of its own ones right.
#pragma once

#include "rubato/domain/quadrature_states.hpp"
#include "rubato/domain/rank_parts.hpp"

namespace rubato::domain {

/// Those of all cells, records in the order of the whole bulk. Called by all ranks together.
QuadratureStates whole_states(QuadratureStates own, const mesh::Mesh& mesh, const Bulk& bulk,
                              const RankParts& parts);

/// Of whole ones: the records of this rank's cells, and all values.
QuadratureStates own_states(QuadratureStates whole, const mesh::Mesh& mesh, const Bulk& bulk,
                            const RankParts& parts);

} // namespace rubato::domain
