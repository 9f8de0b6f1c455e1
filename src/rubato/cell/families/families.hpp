// SPDX-License-Identifier: LGPL-3.0-or-later
/// The table of reference cells, family by family; each lives in the file of its name.
#pragma once

#include "rubato/cell/reference_cell.hpp"

#include <span>

namespace rubato::cell {

std::span<const ReferenceCell> seg_cells();
std::span<const ReferenceCell> tria_cells();
std::span<const ReferenceCell> quad_cells();
std::span<const ReferenceCell> tetra_cells();
std::span<const ReferenceCell> pyra_cells();
std::span<const ReferenceCell> penta_cells();
std::span<const ReferenceCell> hexa_cells();

} // namespace rubato::cell
