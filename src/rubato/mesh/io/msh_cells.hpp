// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: Gmsh's cell types and the order of their nodes.
#pragma once

#include "rubato/cell/topology.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace rubato::mesh::msh {

struct KnownType {
  int gmsh; ///< Gmsh's number of the type
  CellType ours;
  std::span<const std::uint8_t> order; ///< our node i is Gmsh's node order[i]; empty when the orders agree
};

/// nullptr for a type that this project doesn't know.
const KnownType* find_type(std::int64_t gmsh);

/// What a fault calls an unknown type: "21 (10-node triangle)", with what to do where that is known.
std::string unknown_type(std::int64_t gmsh);

} // namespace rubato::mesh::msh
