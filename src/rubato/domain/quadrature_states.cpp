// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/quadrature_states.hpp"

#include "rubato/cell/quadrature.hpp"

namespace rubato::domain {

QuadratureStates initial_states(const mesh::Mesh& mesh, const Bulk& bulk) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i)
    if (const int size = material::state_size(bulk.law(i)); size > 0)
      count += static_cast<std::size_t>(size) * cell::stiffness_rule(mesh.type_of(bulk.cells[i])).size();
  return {std::vector<double>(count, 0.0)};
}

} // namespace rubato::domain
