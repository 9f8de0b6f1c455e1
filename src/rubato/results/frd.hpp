// SPDX-License-Identifier: LGPL-3.0-or-later
/// CalculiX's .frd files, as CalculiX GraphiX and PrePoMax read them: a mesh, then blocks of values at its
/// nodes, one after another.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::results {

enum class FrdKind { scalar, vector, tensor };

/// Values at all nodes of the mesh.
struct FrdBlock {
  std::string_view name; ///< "DISP"
  FrdKind kind = FrdKind::scalar;
  std::vector<std::string_view> components; ///< "D1", "D2", "D3"
  std::vector<double> values;               ///< node-major; tensors as SXX SYY SZZ SXY SYZ SZX
};

struct FrdSettings {
  bool binary = false; ///< numbers of 4 bytes, coordinates of 8
  int step = 1;
  std::vector<std::string> materials;     ///< names
  std::vector<std::int32_t> of_cell = {}; ///< of each cell of the mesh the place of its material; empty: 0
};

/// Where a file is continued.
struct FrdPosition {
  std::uintmax_t bytes = 0; ///< without the line that ends the file
  int instants = 0;
  int blocks = 0;
};

/// Cell types that .frd files do not have are written as types that they have: pyramids as collapsed
/// hexahedra, cells with nodes on faces or inside without these nodes. After every write the file ends with
/// the line " 9999", which the next write replaces.
class FrdFile {
public:
  /// A new file with the mesh. Throws InputError when it cannot be written.
  FrdFile(std::filesystem::path path, const mesh::Mesh& mesh, FrdSettings settings);
  /// Continues a file at `position`; what follows there is removed. Throws InputError when it is shorter.
  FrdFile(std::filesystem::path path, const mesh::Mesh& mesh, FrdSettings settings,
          const FrdPosition& position);

  /// Appends the blocks of an instant; `increment` counts within the step. Throws WriteError and restores the
  /// file.
  void add(double t, int increment, std::span<const FrdBlock> blocks);
  /// Appends the blocks of a natural mode, whose number counts from 1.
  void add_mode(double frequency, int number, std::span<const FrdBlock> blocks);
  void cut(const FrdPosition& position);
  const FrdPosition& position() const { return position_; }

private:
  void add_blocks(double value, int increment, bool modal, std::span<const FrdBlock> blocks);

  std::filesystem::path path_;
  FrdSettings settings_;
  std::vector<std::int32_t> numbers_;  ///< of the nodes that are written
  std::vector<mesh::NodeIndex> nodes_; ///< ascending by number
  FrdPosition position_;
};

/// Joins the files of several steps with the same mesh; instants and blocks are renumbered. Throws InputError
/// when a file cannot be read or has not been written by FrdFile.
void join_frd(std::span<const std::filesystem::path> files, const std::filesystem::path& joined);

} // namespace rubato::results
