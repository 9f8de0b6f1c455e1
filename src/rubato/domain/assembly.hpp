// SPDX-License-Identifier: LGPL-3.0-or-later
/// From element matrices to the sparse matrices of the whole.
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::domain {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Which nodes share a cell: the places of a sparse matrix of dense components × components blocks, both
/// triangles. Every matrix made from one pattern stores the same entries (a mass some zeros), so that sums of
/// them are sums of their value arrays.
class BlockPattern {
public:
  /// Throws std::length_error when the matrix would have more entries than an int can count.
  BlockPattern(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells, const DofMap& dofs);

  /// All entries stored, all zero.
  SparseMatrix zero_matrix() const;

  /// Adds an element matrix, node-major (nodes · components square), of a cell with those nodes.
  void add(std::span<const mesh::NodeIndex> nodes, const Eigen::MatrixXd& element,
           SparseMatrix& matrix) const;

  /// Adds m ⊗ 1, m square of size nodes.
  void add_to_diagonals(std::span<const mesh::NodeIndex> nodes, const Eigen::MatrixXd& m,
                        SparseMatrix& matrix) const;

private:
  std::int32_t number_of(mesh::NodeIndex node) const;
  std::int64_t place_in_column(std::int32_t row_node, std::int32_t column_node) const;

  int components_;
  std::vector<std::int32_t> first_dof_;  ///< of mesh nodes
  std::vector<std::int64_t> start_;      ///< of numbered nodes: where its neighbours begin
  std::vector<std::int32_t> neighbours_; ///< numbered nodes, ascending, each beside itself too
};

/// Stiffness of the whole where nothing has happened yet, times `factors[law]` for the cells of each law when
/// factors are given (Rayleigh damping). Cells must be sound (cell_faults). Throws InputError, with the cell,
/// when its matrix is not finite.
SparseMatrix assemble_stiffness(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                                std::span<const double> factors = {});

/// The part of the cells that keep their stiffness (Bulk::is_constant).
SparseMatrix assemble_constant_stiffness(const mesh::Mesh& mesh, const Bulk& bulk,
                                         const BlockPattern& pattern);

/// Consistent mass of the whole, times `factors[law]` likewise.
SparseMatrix assemble_mass(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                           std::span<const double> factors = {});

/// Lumped mass, one entry a dof (element.hpp's lumped_mass), times `factors[law]` likewise.
Eigen::VectorXd lumped_mass(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                            std::span<const double> factors = {});

} // namespace rubato::domain
