// SPDX-License-Identifier: LGPL-3.0-or-later
/// The mesh of an input file of Abaqus or CalculiX (.inp).
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>

namespace rubato::mesh {

/// Nodes, elements, sets and surfaces of an .inp file, whose parts stand where its instances say. Sets become
/// groups of nodes and of cells, surfaces groups of faces (TYPE=NODE: of nodes); faces that *DLOAD presses on
/// are the group "SET.P3". Nodes and cells have the numbers of the file; where instances share numbers, those
/// after the first have a power of ten added for each instance. What is no mesh is passed over, but every
/// keyword must be one of Abaqus or CalculiX. Throws InputError with every fault, each with file:line:column.
Mesh read_inp(const std::filesystem::path& path);

} // namespace rubato::mesh
