// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: what the reader asks of Gmsh's library. It drags in a hundred others, which would
/// cost every start of a program a tenth of a second; so it is not linked with but loaded when first needed.
#pragma once

#include <filesystem>
#include <string>

namespace rubato::mesh::gmsh {

struct Calls;

/// Loads the library. Throws InputError when it is not there or lacks a call.
const Calls& library();

/// Gmsh between its initialize and its finalize; one at a time. What Gmsh refuses becomes a
/// std::runtime_error in its own words.
class Session {
public:
  /// Throws as library() does.
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  void open(const std::filesystem::path& path) const;
  /// Meshes the geometry up to that dimension.
  void generate(int dimension) const;
  /// The first error that Gmsh has reported so far; empty when there is none.
  std::string first_error() const;

  /// The highest dimension of a piece of the geometry.
  int dimension() const;
  /// Whether there are cells.
  bool is_meshed() const;
  /// Writes the mesh as a binary .msh file of version 4.1: the cells in physical groups, every cell when
  /// there are none.
  void write(const std::filesystem::path& path) const;

private:
  const Calls& calls_;
};

} // namespace rubato::mesh::gmsh
