// SPDX-License-Identifier: LGPL-3.0-or-later
/// Fields at nodes, from files of results.
#pragma once

#include "rubato/mesh/nodal_samples.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace rubato::mesh {

/// Which component of which field, and when.
struct WantedField {
  std::string name;
  std::string component;    ///< empty: the field has one only
  std::optional<double> at; ///< an instant of the file; all of them when not given
};

/// Reads a field from a MED file (.med, .rmed, .mmed), a .vtu file, which has no instants, or a .pvd
/// collection of them. Throws InputError, a sentence that names the file, when it is absent, is of another
/// kind or cannot be read, and when it has no such field, component or instant at the nodes: the nearest one
/// is told.
NodalSamples read_nodal_field(const std::filesystem::path& path, const WantedField& wanted);

} // namespace rubato::mesh
