// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: numbers of nodes and cells, and texts of numbers, as files of CalculiX have them.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rubato::results {

/// Numbers of the mesh file. If they are not unique or not between 1 and the largest 32-bit integer, nodes or
/// cells are numbered from 1 in the order of the mesh.
struct CcxNumbers {
  std::vector<std::int32_t> nodes;
  std::vector<std::int32_t> cells;
};
CcxNumbers ccx_numbers(const mesh::Mesh& mesh);

/// Fortran's Ew.d with a leading 0: 0.5000000E+00 of 7 digits.
std::string fortran_e(double value, int digits);

/// Returns whether cells of the type have the highest dimension in the mesh: files of results contain only
/// these.
bool is_shown(const mesh::Mesh& mesh, CellType type);

} // namespace rubato::results
