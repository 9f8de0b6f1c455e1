// SPDX-License-Identifier: LGPL-3.0-or-later
/// Fields for ParaView in one file with all instants: VTKHDF (VTK file formats, "VTKHDF file format", version
/// 2.0: an unstructured grid with steps). The mesh is there once.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/field.hpp"

#include <cstdint>
#include <filesystem>
#include <span>

namespace rubato::results {

/// Writes a file with the bodies, their groups and no instant. Throws InputError when it cannot be made,
/// WriteError when it cannot be written.
void start_vtkhdf(const std::filesystem::path& path, const mesh::Mesh& mesh);

struct VtkHdfInstant {
  std::int64_t number = 0; ///< from 0 on; instants that the file has from that number on are gone then
  double time = 0;
};

/// Appends the fields of one instant, the same as at the instants before; those in cells as their means. The
/// file is closed afterwards, so that a run that stops leaves a file which can be read. `digits`: of values
/// that are kept (mesh::with_digits). Throws WriteError, before the file is touched when the disk has no room
/// for it.
void append_vtkhdf(const std::filesystem::path& path, const mesh::Mesh& mesh, VtkHdfInstant instant,
                   std::span<const NodalField> fields, std::span<const CellField> cell_fields, int digits);

/// How many instants the file has. Throws InputError when it cannot be read.
std::int64_t instants_in_vtkhdf(const std::filesystem::path& path);

} // namespace rubato::results
