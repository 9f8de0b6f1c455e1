// SPDX-License-Identifier: LGPL-3.0-or-later
/// The types of cells; their nodes, sides and edges are in cell/topology.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rubato {

enum class CellType : std::uint8_t {
  point1,
  seg2,
  seg3,
  tria3,
  tria6,
  tria7,
  quad4,
  quad8,
  quad9,
  tetra4,
  tetra10,
  pyra5,
  pyra13,
  penta6,
  penta15,
  penta18,
  hexa8,
  hexa20,
  hexa27 // the last: cell_type_count
};

/// Sizes tables by cell type.
inline constexpr std::size_t cell_type_count = static_cast<std::size_t>(CellType::hexa27) + 1;

} // namespace rubato
