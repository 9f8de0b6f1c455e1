// SPDX-License-Identifier: LGPL-3.0-or-later
/// Code_Aster's own mesh files (.mail): text in blocks of words.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>

namespace rubato::mesh {

/// The mesh of a .mail file (Code_Aster documentation U3.01.00): blocks TITRE, COOR_2D or COOR_3D, cells by
/// type, GROUP_NO and GROUP_MA in any order, each ended by FINSF, and FIN. Nodes and cells have the names of
/// the file, and count from 1 in its order. Throws InputError with file:line:column for the first fault: an
/// unknown block, node or cell, a name given twice, a block or file without end, words that stand on the line
/// of a block's keyword or beyond column 80, where Code_Aster reads nothing; and for a file that is absent or
/// holds no cells.
Mesh read_mail(const std::filesystem::path& path);

/// Writes nodes, cells and groups; nodes and cells without a name are called by their number, "N90", "M90".
/// Throws InputError when the file can't be made or a name is none of Code_Aster's (8 letters, of groups 24,
/// no blanks and none of , % =), WriteError when the file can't be written to its end (the former one is
/// still there then).
void write_mail(const std::filesystem::path& path, const Mesh& mesh);

} // namespace rubato::mesh
