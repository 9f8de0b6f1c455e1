// SPDX-License-Identifier: LGPL-3.0-or-later
/// Two runs side by side: the difference A − B of a field at the nodes, or of the histories of a probe.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/results/csv.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::results {

/// A field of both runs at one instant, node-major.
struct FieldComparison {
  std::string field;
  std::vector<std::string> components; ///< names; one without a name for a scalar
  double at = 0;                       ///< the stored instant
  mesh::Mesh mesh;                     ///< both runs'
  std::vector<double> a;
  std::vector<double> b;
  std::vector<double> difference; ///< A − B
};

/// Reads the field of two run folders from their fields.med. Throws InputError when a folder is no run's,
/// when it stores no MED fields, no such field or not at that instant (the nearest are said), and when the
/// two meshes differ.
FieldComparison compare_fields(const std::filesystem::path& run_a, const std::filesystem::path& run_b,
                               const std::string& field, double at);

/// How far one component differs over some nodes.
struct Extent {
  std::string component;
  double difference = 0;    ///< A − B where it is largest
  mesh::NodeIndex node = 0; ///< where that is
  double rms = 0;           ///< √(Σ (A − B)² / nodes)
  double largest_a = 0;     ///< max |A| over the nodes
  double largest_b = 0;
};

/// One entry a component. `nodes`: at least one.
std::vector<Extent> extents(const FieldComparison& fields, std::span<const mesh::NodeIndex> nodes);

std::vector<mesh::NodeIndex> all_nodes(const mesh::Mesh& mesh);

/// The nodes of a group, or the node of that number. Throws InputError with the nearest group when the name
/// means nothing.
std::vector<mesh::NodeIndex> nodes_of(const mesh::Mesh& mesh, const std::string& name);

/// Writes FIELD_difference, FIELD_A and FIELD_B on the mesh, for ParaView. Throws InputError when the file
/// can't be written.
void write_vtu(const std::filesystem::path& path, const FieldComparison& fields);

/// How far one column of the probes differs.
struct HistoryComparison {
  std::string quantity; ///< "tip.y"
  int instants = 0;     ///< compared
  double at = 0;        ///< where the difference is largest
  double a = 0;         ///< values there
  double b = 0;
  double largest_a = 0; ///< max |A| over the instants compared
  double difference() const { return a - b; }
};

/// Compares the probe ("tip": every component; "tip.y") at one instant, between two rows linearly, or at all
/// instants that both histories have. Throws InputError when a history lacks the probe or the instant, or
/// when no instant is common.
std::vector<HistoryComparison> compare_histories(const Table& a, const Table& b, const std::string& probe,
                                                 std::optional<double> at = {});

} // namespace rubato::results
