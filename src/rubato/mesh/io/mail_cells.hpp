// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: Code_Aster's cell types and the order of their nodes.
#pragma once

#include "rubato/cell/topology.hpp"

#include <cstdint>
#include <span>
#include <string_view>

namespace rubato::mesh::mail {

struct KnownType {
  std::string_view name; ///< Code_Aster's: "PYRAM5"
  CellType ours;
  std::span<const std::uint8_t> order; ///< our node i is Code_Aster's node order[i]; empty: the orders agree
};

/// Every cell type, in the order of CellType.
std::span<const KnownType> all_types();

/// nullptr when no type has that name.
const KnownType* type_named(std::string_view name);

} // namespace rubato::mesh::mail
