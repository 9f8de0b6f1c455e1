// SPDX-License-Identifier: LGPL-3.0-or-later
/// Runs of benchmarks of bodies: a deck on a mesh, read by the deck's probes.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include "support/walk.hpp"
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {

/// Where a node of the generated mesh is put.
using MeshShape = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

/// A deck of one run, static or implicit.
class BulkRun {
public:
  /// On the deck's own mesh; with `shape`, its nodes are moved there.
  explicit BulkRun(std::string_view deck, const MeshShape& shape = {});
  /// On that mesh.
  BulkRun(std::string_view deck, mesh::Mesh mesh);

  /// Steps until that instant is reached. Throws std::runtime_error when a step fails in spite of all cuts.
  void go_to(double t);
  void to_end() { go_to(walk_.simulation.end()); }
  /// Of a probe "name.component", or "name" of a scalar, now. Throws std::out_of_range when there is none.
  double probe(const std::string& column) const;
  /// A field of the cells, "cumulated_plastic_strain_elga", cell by cell, place by place.
  std::vector<double> cell_values(const std::string& field) const;
  const test::Walk& walk() const { return walk_; }

  /// Bulk residuals of the last step that needed most iterations, of all steps so far.
  std::vector<double> hardest_step() const;
  /// Of bulk iterations of all steps so far, and of cuts.
  int iterations() const;
  int cuts() const;

private:
  test::Walk walk_;
};

/// How fast residuals fall at the end: log(r₃/r₂)/log(r₂/r₁) of the last three that are above rounding, 2
/// where they converge quadratically. A residual is at rounding that is below 1e-13 of the largest one of the
/// step. Nothing where fewer than three are above it, or where r₂ is not below r₁.
std::optional<double> order_of(const std::vector<double>& residuals);

} // namespace rubato::verification
