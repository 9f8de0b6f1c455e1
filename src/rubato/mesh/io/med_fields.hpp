// SPDX-License-Identifier: LGPL-3.0-or-later
/// Fields at nodes of MED files, read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rubato::mesh {

/// An instant of a computation: MED keeps its numbers and the time.
struct MedInstant {
  int number = 0; ///< ≥ 0, another one for every instant
  double time = 0.0;
  int iteration = -1; ///< MED_NO_IT: none
};

/// A field as a MED file holds it.
struct MedField {
  std::string name;
  std::string mesh_name;
  std::vector<std::string> component_names;
  std::string unit; ///< of the first component
  std::string time_unit;
  std::vector<MedInstant> instants;
  bool at_nodes = true; ///< else in cells: it cannot be read here
};

/// The fields of real numbers of a MED file. Throws InputError when the file can't be read.
std::vector<MedField> med_fields(const std::filesystem::path& path);

/// The values at the nodes, node-major, at the instant of that number; nan at the nodes that the field leaves
/// out (by a profile). Throws InputError when the file can't be read or has no such field or instant.
std::vector<double> read_med_field(const std::filesystem::path& path, const std::string& field, int number);

} // namespace rubato::mesh
