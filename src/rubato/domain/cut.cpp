// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/cut.hpp"

#include "rubato/domain/cell_matrices.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace rubato::domain {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using mesh::NodeIndex;
using Entries = std::vector<Eigen::Triplet<double, int>>;

constexpr Index axes = 3;

/// What a force along an axis at a place does: force along and moment about each axis.
Eigen::Matrix<double, 6, 1> effect_of(Index axis, const Eigen::Vector3d& arm) {
  const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
  Eigen::Matrix<double, 6, 1> effect;
  effect << along, arm.cross(along);
  return effect;
}

/// Adds the effects of the internal forces of one cell at those of its nodes that are in the cut.
void add_cell(const mesh::Mesh& mesh, const DofMap& dofs, std::span<const NodeIndex> nodes,
              const std::vector<char>& in_cut, const Eigen::Vector3d& point, const MatrixXd& stiffness,
              Entries& entries) {
  const Index d = dofs.components;
  MatrixXd effects = MatrixXd::Zero(2 * axes, stiffness.cols());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (in_cut[static_cast<std::size_t>(nodes[n])] != 0)
      for (Index a = 0; a < d; ++a)
        effects += effect_of(a, mesh.points[static_cast<std::size_t>(nodes[n])] - point) *
                   stiffness.row(static_cast<Index>(n) * d + a);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (Index b = 0; b < d; ++b)
      for (Index row = 0; row < effects.rows(); ++row)
        if (const double value = effects(row, static_cast<Index>(n) * d + b); value != 0)
          entries.emplace_back(static_cast<int>(row), dofs.dof(nodes[n], static_cast<int>(b)), value);
}

} // namespace

CutForces make_cut_forces(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                          std::span<const std::size_t> cells, std::span<const NodeIndex> nodes,
                          const Eigen::Vector3d& point) {
  std::vector<char> in_cut(mesh.points.size(), 0);
  for (const auto node : nodes)
    in_cut[static_cast<std::size_t>(node)] = 1;
  Entries entries;
  for (const auto i : cells) {
    const auto of_cell = mesh.nodes_of(bulk.cells[i]);
    if (std::ranges::none_of(of_cell, [&](NodeIndex n) { return in_cut[static_cast<std::size_t>(n)] != 0; }))
      continue;
    const auto size = static_cast<Index>(of_cell.size()) * dofs.components;
    MatrixXd stiffness(size, size);
    cell_stiffness(bulk, i, mesh.type_of(bulk.cells[i]), CellPoints(mesh, of_cell), stiffness);
    add_cell(mesh, dofs, of_cell, in_cut, point, stiffness, entries);
  }
  CutForces cut;
  cut.of_displacement.resize(2 * axes, dofs.dof_count);
  cut.of_displacement.setFromTriplets(entries.begin(), entries.end());
  return cut;
}

Eigen::Matrix<double, 6, 1> forces_at(const CutForces& cut, const Eigen::VectorXd& u) {
  return cut.of_displacement * u;
}

} // namespace rubato::domain
