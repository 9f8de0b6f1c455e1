// SPDX-License-Identifier: LGPL-3.0-or-later
/// What materials remember at quadrature points.
#pragma once

#include "rubato/domain/bulk.hpp"

#include <vector>

namespace rubato::domain {

/// Of each cell in the order of Bulk::cells, and of each of its points in the order of
/// cell::stiffness_rule: as many numbers as its law has (material::state_size). None where no law remembers
/// anything.
struct QuadratureStates {
  std::vector<double> values;
  bool operator==(const QuadratureStates&) const = default;
};

/// Of cells that nothing has happened to: zeros.
QuadratureStates initial_states(const mesh::Mesh& mesh, const Bulk& bulk);

} // namespace rubato::domain
