// SPDX-License-Identifier: LGPL-3.0-or-later
/// Fields for ParaView: one .vtu file an instant, and the .pvd file that says which belongs to which time.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/field.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rubato::results {

struct VtuOptions {
  /// Displacements to add to the coordinates, node-major, node_count · mesh.dimension; empty: the shape at
  /// rest.
  std::span<const double> displacement = {};
  std::span<const CellField> cell_fields = {}; ///< written as their means over each cell
  int digits = 17;                             ///< of the numbers that are kept (mesh::with_digits)
  bool all_cells = false; ///< faces, edges and points too, not the cells of highest dimension alone
};

/// Writes the fields on the mesh. Fields of two components get a third one of zeros, as VTK wants vectors.
/// Throws InputError when the file can't be written; std::invalid_argument for a field of the wrong size and
/// for fields in cells beside `all_cells`.
void write_vtu(const std::filesystem::path& path, const mesh::Mesh& mesh, std::span<const NodalField> fields,
               const VtuOptions& options = {});

/// A .pvd collection. After each addition the whole file is written beside and then renamed, so that a run
/// that stops leaves a series which can be read.
class PvdSeries {
public:
  struct Entry {
    double time = 0.0;
    std::filesystem::path file; ///< as the .pvd names it: relative to its own folder
  };

  /// `entries`: what a run that goes on has already written. Nothing is written before the first add.
  explicit PvdSeries(std::filesystem::path path, std::vector<Entry> entries = {});

  /// Writes the series, or removes its file when there is nothing in it.
  void rewrite() const;

  /// Adds a file, by the path this program would open it with, at a time. Throws InputError when the series
  /// can't be made, WriteError when writing it fails: the former one is still there then.
  void add(double time, const std::filesystem::path& file);

  const std::vector<Entry>& entries() const { return entries_; }

private:
  void write() const;

  std::filesystem::path path_;
  std::vector<Entry> entries_;
};

} // namespace rubato::results
