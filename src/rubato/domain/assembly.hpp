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

  /// The same before anything is written to the values.
  SparseMatrix matrix_without_values() const;
  /// How many columns there are up to the last one of these nodes.
  int columns_up_to(std::span<const mesh::NodeIndex> nodes) const;

  /// Adds an element matrix, node-major (nodes · components square), of one of the cells, which has those
  /// nodes.
  void add(mesh::CellIndex cell, std::span<const mesh::NodeIndex> nodes, const Eigen::MatrixXd& element,
           SparseMatrix& matrix) const;

  /// Adds m ⊗ 1, m square of size nodes.
  void add_to_diagonals(mesh::CellIndex cell, std::span<const mesh::NodeIndex> nodes,
                        const Eigen::MatrixXd& m, SparseMatrix& matrix) const;

private:
  std::int32_t number_of(mesh::NodeIndex node) const;
  /// Of the column of node `own` of a cell, where the blocks of its nodes begin.
  void put_places(mesh::CellIndex cell, std::int32_t own, const mesh::Mesh& mesh,
                  std::span<const std::int32_t> place_of);
  /// Calls visit(node of the cell, column of its block, where the blocks of the nodes of the cell begin in
  /// the column, the values of the column).
  template <class Visit>
  void visit_columns(mesh::CellIndex cell, std::span<const mesh::NodeIndex> nodes, SparseMatrix& matrix,
                     const Visit& visit) const;

  int components_;
  std::vector<std::int32_t> first_dof_;   ///< of mesh nodes
  std::vector<std::int64_t> start_;       ///< of numbered nodes: where its neighbours begin
  std::vector<std::int32_t> neighbours_;  ///< numbered nodes, ascending, each beside itself too
  std::vector<std::int64_t> first_place_; ///< of cells of the mesh, in places_
  /// Of each cell, node by node: where the row block of one begins in the columns of another.
  std::vector<std::int32_t> places_;
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
