// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the entries of matrices of the whole are.
#pragma once

#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/work_shares.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::domain {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Which nodes share a cell: the places of a sparse matrix of dense components × components blocks, both
/// triangles. Every matrix made from one pattern stores the same entries (a mass some zeros), so that sums of
/// them are sums of their value arrays. It knows, too, which thread computes which of the cells; the matrices
/// do not depend on that.
class BlockPattern {
public:
  /// Throws std::length_error when the matrix would have more entries than an int can count.
  BlockPattern(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells, const DofMap& dofs,
               const Threads& threads = {});

  /// All entries stored, all zero.
  SparseMatrix zero_matrix() const;

  /// The same before anything is written to the values.
  SparseMatrix matrix_without_values() const;

  /// In the order they were given in.
  std::span<const mesh::CellIndex> cells() const { return cells_; }
  /// These, dealt out to threads.
  const WorkShares& shares() const { return shares_; }

  int components() const { return components_; }
  int first_dof(mesh::NodeIndex node) const { return first_dof_[static_cast<std::size_t>(node)]; }
  /// Of one of the cells, which has so many nodes: node by node, where the row block of one begins in the
  /// columns of another.
  std::span<const std::int32_t> places(mesh::CellIndex cell, std::size_t nodes) const {
    return {places_.data() + first_place_[static_cast<std::size_t>(cell)], nodes * nodes};
  }

private:
  std::int32_t number_of(mesh::NodeIndex node) const;
  /// Of the column of node `own` of a cell, where the blocks of its nodes begin.
  void put_places(mesh::CellIndex cell, std::int32_t own, const mesh::Mesh& mesh,
                  std::span<const std::int32_t> place_of);

  int components_;
  std::vector<mesh::CellIndex> cells_;
  WorkShares shares_;
  std::vector<std::int32_t> first_dof_;   ///< of mesh nodes
  std::vector<std::int64_t> start_;       ///< of numbered nodes: where its neighbours begin
  std::vector<std::int32_t> neighbours_;  ///< numbered nodes, ascending, each beside itself too
  std::vector<std::int64_t> first_place_; ///< of cells of the mesh, in places_
  /// Of each cell, node by node: where the row block of one begins in the columns of another. Threads touch
  /// its memory first.
  Eigen::ArrayX<std::int32_t> places_;
};

} // namespace rubato::domain
