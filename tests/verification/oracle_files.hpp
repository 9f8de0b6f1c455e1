// SPDX-License-Identifier: LGPL-3.0-or-later
/// Histories by Code_Aster, and the two beams that most of them are of.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rubato::verification {

/// A row of numbers a line of the file, after its header.
using OracleTable = std::vector<std::vector<double>>;

std::filesystem::path oracle_file(const std::string& name);
bool has_oracle_file(const std::string& name);
OracleTable oracle_table(const std::string& name);

/// "[0.001, 0.002]": those after the first row.
std::string oracle_instants(const std::string& name);

/// What `mesh.generate` has: HEXA8 or QUAD4, 20 × 2 a beam, with the groups of SDNL140, the edge `edge` at
/// the end of the upper beam in space, and its corner `tip`.
std::string oracle_beams(bool solid);

} // namespace rubato::verification
