// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/quadrature_states.hpp"

#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/element/nonlinear.hpp"

namespace rubato::domain {

std::size_t state_size(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell) {
  const auto* behaviour = bulk.behaviour(cell);
  if (behaviour == nullptr)
    return 0;
  const auto kind = kind_of(bulk, *behaviour, mesh.type_of(bulk.cells[cell]));
  return static_cast<std::size_t>(element::state_size_of_cell(kind, material::state_size(behaviour->law)));
}

QuadratureStates initial_states(const mesh::Mesh& mesh, const Bulk& bulk) {
  std::size_t count = 0;
  for (std::size_t i = 0; !bulk.behaviours.empty() && i < bulk.cells.size(); ++i)
    count += state_size(mesh, bulk, i);
  return {std::vector<double>(count, 0.0)};
}

} // namespace rubato::domain
