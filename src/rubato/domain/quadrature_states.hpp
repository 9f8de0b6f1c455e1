// SPDX-License-Identifier: LGPL-3.0-or-later
/// What materials remember at quadrature points.
#pragma once

#include "rubato/element/point_record.hpp"
#include "rubato/mesh/mesh.hpp"

#include <cstddef>
#include <vector>

namespace rubato::domain {

struct Bulk;

struct QuadratureStates {
  /// Of each cell that has a behaviour (Bulk::behaviour), in the order of Bulk::cells: as many numbers as it
  /// remembers (element::state_size_of_cell).
  std::vector<double> values;
  /// Of all points of those that are not constant, where they were asked for.
  std::vector<element::PointRecord> records = {};
  double mode_force = 0; ///< the largest one of their cells (element::CellResult)
  bool operator==(const QuadratureStates&) const = default;
};

/// The largest growth of the cumulated plastic strain in a step.
struct PlasticStep {
  double growth = 0;
  mesh::CellIndex cell = -1; ///< where; −1: nothing has yielded
};

/// How many numbers a cell remembers, by its place in Bulk::cells.
std::size_t state_size(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell);

/// Of cells that nothing has happened to: zeros.
QuadratureStates initial_states(const mesh::Mesh& mesh, const Bulk& bulk);

} // namespace rubato::domain
