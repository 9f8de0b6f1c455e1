// SPDX-License-Identifier: LGPL-3.0-or-later
/// The fields that a run has stored at an instant, from its fields.med or its fields.pvd.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rubato::plot {

struct NodeArray {
  std::string name;
  std::vector<std::string> components = {}; ///< names, at least one
  std::vector<double> values = {};          ///< node-major
};

struct Snapshot {
  double t = 0;
  mesh::Mesh mesh = {}; ///< undeformed, its bulk cells positive
  std::vector<NodeArray> arrays = {};
};

/// At the instant, or at the last one that is stored. `dimension`: of the study, 2 or 3. Throws InputError
/// when the run has stored no fields, none at the instant (the nearest are said), or files cannot be read.
Snapshot read_snapshot(const std::filesystem::path& run, std::optional<double> at, int dimension);

/// A value at each node, of "von_mises", "stress.xx" or "displacement", of whose components it is the length.
struct NodeValues {
  std::string name;      ///< as asked for
  std::string dimension; ///< "force/length²"
  std::vector<double> values;
};

/// Throws InputError, with the nearest name, when there is no such field.
NodeValues node_values(const Snapshot& snapshot, const std::string& name);

/// The displacements of the nodes [length]. Throws InputError when they were not stored.
std::vector<Eigen::Vector3d> displacements(const Snapshot& snapshot);

} // namespace rubato::plot
