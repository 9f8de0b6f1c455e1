// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: what the reader asks of Gmsh's library. It drags in a hundred others, which would
/// cost every start of a program a tenth of a second; so it is not linked with but loaded when first needed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::mesh::gmsh {

using Tag = std::size_t;

/// A piece of the geometry or a physical group: its dimension, and its number among those of that dimension.
struct Entity {
  int dimension = 0;
  int tag = 0;
};
constexpr Entity everything{-1, -1};

/// Cells by type; those of one type stand in one list, their nodes one cell after another.
struct Elements {
  std::vector<int> types;
  std::vector<std::vector<Tag>> cells; ///< one list a type
  std::vector<std::vector<Tag>> nodes; ///< one list a type
};

struct Nodes {
  std::vector<Tag> tags;
  std::vector<double> coordinates; ///< x, y, z of each
};

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

  std::vector<Entity> entities() const;
  std::vector<Entity> physical_groups() const;
  std::string name_of(Entity physical_group) const;
  std::vector<int> entities_of(Entity physical_group) const;
  Elements elements_of(Entity entity) const;
  Nodes nodes_of(Entity entity) const;
  std::string name_of_type(int element_type) const;

private:
  const Calls& calls_;
};

} // namespace rubato::mesh::gmsh
