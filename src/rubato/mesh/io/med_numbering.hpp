// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: MED's cell types and the order of their nodes.
#pragma once

#include "rubato/cell/topology.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace rubato::mesh::med {

/// MED's number of a cell type (MED_HEXA20 = 320), and back: nothing for a MED type unknown here.
int geometry_of(CellType type);
std::optional<CellType> type_of_geometry(int geometry);

/// Our node i is MED's node order[i]. Empty when the orders agree (points, segments, surfaces).
std::span<const std::uint8_t> node_order(CellType type);

} // namespace rubato::mesh::med
