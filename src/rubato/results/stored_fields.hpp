// SPDX-License-Identifier: LGPL-3.0-or-later
/// The fields that a run stored, read back instant by instant from its .vtu files or from its fields.med.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rubato::results {

/// A field at the nodes.
struct FieldLayout {
  std::string name;
  std::vector<std::string> components; ///< names; one without a name for a scalar
};

struct StoredFields {
  mesh::Mesh mesh;
  std::vector<double> instants; ///< ascending [time]
  std::vector<FieldLayout> fields;
  /// The values of every field at the instant of that index, in the order of `fields`, node-major. Throws
  /// InputError when they cannot be read.
  std::function<std::vector<std::vector<double>>(std::size_t)> values_at;
};

/// From fields.pvd and the files that it names; nothing when there is no such file or it names none. Throws
/// InputError when a file cannot be read.
std::optional<StoredFields> stored_vtu_fields(const std::filesystem::path& run);

/// From fields.med; nothing when there is no such file or it holds no field. Throws InputError when it cannot
/// be read.
std::optional<StoredFields> stored_med_fields(const std::filesystem::path& run);

/// Of both, what has more instants; .vtu files where they have as many, as these are read once an instant.
/// Nothing when the run stored no fields.
std::optional<StoredFields> stored_fields(const std::filesystem::path& run);

} // namespace rubato::results
