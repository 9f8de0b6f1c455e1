// SPDX-License-Identifier: LGPL-3.0-or-later
/// The .pvd and .vtu files that runs write, read back.
#pragma once

#include "rubato/plot/snapshot.hpp"

#include <filesystem>
#include <vector>

namespace rubato::plot {

struct PvdEntry {
  double t = 0;
  std::filesystem::path file; ///< as this program opens it
};

/// In the order of the file. Throws InputError when it cannot be read.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

struct VtuContent {
  mesh::Mesh mesh; ///< points and cells; of dimension 3
  std::vector<NodeArray> arrays;
};

/// Throws InputError when the file cannot be read, or is not as results::write_vtu writes it: appended raw
/// data in the byte order of this machine.
VtuContent read_vtu(const std::filesystem::path& path);

} // namespace rubato::plot
