// SPDX-License-Identifier: LGPL-3.0-or-later
/// Fields in MED files, beside the mesh they belong to (mesh::write_med).
#pragma once

#include "rubato/mesh/io/med_fields.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/field.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rubato::results {

/// An instant of a computation: MED keeps both the number and the time.
using Instant = mesh::MedInstant;
using mesh::med_fields;
using mesh::MedField;
using mesh::read_med_field;

/// Appends the fields at one instant to a MED file that holds the mesh of that name. The file is closed
/// afterwards, so that a run that stops leaves a file which can be read. A field is declared when it first
/// comes. Throws WriteError, before the file is touched, when the disk has no room for it; InputError when
/// the file can't be opened or lacks the mesh, when a name is too long for MED (field 64, component and unit
/// 16 letters); std::invalid_argument when a field's size is not node count times components or its
/// components differ from those in the file. Fields in cells are written at their nodes (MED_NODE_ELEMENT) or
/// at their Gauss points (MED_CELL with a localisation for each cell type).
void append_med_fields(const std::filesystem::path& path, const std::string& mesh_name, Instant instant,
                       std::span<const NodalField> fields, const std::string& time_unit = "",
                       std::span<const CellField> cell_fields = {});

} // namespace rubato::results
