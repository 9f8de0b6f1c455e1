// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the entries of matrices of the whole are.
#pragma once

#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/sparse_matrix.hpp"
#include "rubato/domain/work_shares.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::domain {

/// Of the components × components block that two nodes have in a matrix.
enum class BlockEntries {
  all,
  diagonal ///< of matrices m ⊗ 1, as a mass: directions are left alone
};

/// Which nodes share a cell: the places of a sparse matrix of components × components blocks, both triangles.
/// It knows, too, which thread computes which of the cells; the matrices do not depend on that.
class BlockPattern {
public:
  /// Throws std::length_error when the matrix would have more entries than an int can count.
  BlockPattern(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells, const DofMap& dofs,
               const Threads& threads = {});

  /// All entries of blocks stored, all zero.
  SparseMatrix zero_matrix() const;

  /// With these entries, before anything is written to the values.
  SparseMatrix matrix_without_values(BlockEntries entries) const;

  /// In the order they were given in.
  std::span<const mesh::CellIndex> cells() const { return cells_; }
  /// These, dealt out to threads.
  const WorkShares& shares() const { return shares_; }

  int components() const { return components_; }
  int first_dof(mesh::NodeIndex node) const { return first_dof_[static_cast<std::size_t>(node)]; }
  /// Of one of the cells, which has so many nodes: node by node, which place its block with each of them has
  /// in the columns of the one.
  std::span<const std::int32_t> places(mesh::CellIndex cell, std::size_t nodes) const {
    return {places_.data() + first_place_[static_cast<std::size_t>(cell)], nodes * nodes};
  }

private:
  std::int32_t number_of(mesh::NodeIndex node) const { return number_[static_cast<std::size_t>(node)]; }
  void put_rows(std::span<const std::int32_t> neighbours, BlockEntries entries, int* rows) const;
  /// Of the column of node `own` of a cell, where the blocks of its nodes begin.
  void put_places(mesh::CellIndex cell, std::int32_t own, const mesh::Mesh& mesh,
                  std::span<const std::int32_t> place_of);

  int components_;
  std::vector<mesh::CellIndex> cells_;
  WorkShares shares_;
  std::vector<std::int32_t> first_dof_;    ///< of mesh nodes
  std::vector<std::int32_t> number_;       ///< of mesh nodes, where they have dofs
  std::vector<std::int64_t> start_;        ///< of numbered nodes: where its neighbours begin
  Eigen::ArrayX<std::int32_t> neighbours_; ///< numbered nodes, ascending, each beside itself too
  std::vector<std::int64_t> first_place_;  ///< of cells of the mesh, in places_
  /// Of each cell, node by node: the place of their block in the columns of each. Threads touch its memory
  /// first.
  Eigen::ArrayX<std::int32_t> places_;
};

} // namespace rubato::domain
