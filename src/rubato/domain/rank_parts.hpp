// SPDX-License-Identifier: LGPL-3.0-or-later
/// Cells dealt out to ranks, and sums of what they add to nodes.
///
/// Every rank has the whole mesh and vectors with an entry for each dof, but keeps them right only at nodes
/// that it knows: those of its cells, and some that all know, as those of contact surfaces.
#pragma once

#include "rubato/core/channel.hpp"
#include "rubato/core/ranks.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace rubato::domain {

/// Used by all ranks alike. Throws what Channel throws.
class RankParts {
public:
  /// `rank_of_cell`: of each cell of the bulk; `everywhere`: nodes that all ranks know, ascending.
  RankParts(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs, std::span<const int> rank_of_cell,
            std::span<const mesh::NodeIndex> everywhere, const Ranks& ranks);

  const Ranks& ranks() const { return ranks_; }
  /// Of this rank, by their places in the bulk, ascending; it may have none.
  const std::vector<std::size_t>& places() const { return places_; }
  const std::vector<mesh::CellIndex>& cells() const { return cells_; }
  /// Whether values at the dof are right here.
  bool knows(int dof) const { return knows_[static_cast<std::size_t>(dof)] != 0; }
  /// Whether the dof counts here: with one of the ranks that know it.
  bool owns(int dof) const { return owned_[dof] != 0; }
  /// 1 for those, else 0.
  const Eigen::VectorXd& owned() const { return owned_; }

  /// Makes of what the cells of each rank have added to `sum` what all have, at dofs that this rank knows: in
  /// the order of the ranks, so with the same bits on all that know it. How many ranks have `raised` a hand.
  int add_up(Eigen::VectorXd& sum, bool raised = false) const;
  /// Makes values right everywhere that are right where they are known.
  void make_whole(Eigen::VectorXd& values) const;
  /// The same of what the cells of the bulk have: `size_of(place)` numbers each, one after the other.
  template <class SizeOf> void make_whole(std::span<double> values, const SizeOf& size_of) const {
    clear_others(values, size_of);
    ranks_.sum(values);
  }
  /// Puts 0 where other ranks have the cell.
  template <class SizeOf> void clear_others(std::span<double> values, const SizeOf& size_of) const;

  /// Numbers that go to one other rank at least in each `add_up`, and how many go to all.
  std::size_t halo_size() const;
  std::size_t everywhere_size() const { return everywhere_.size(); }

private:
  void find_halo(const std::vector<std::vector<int>>& ranks_of_node, const DofMap& dofs);

  Ranks ranks_;
  std::vector<std::size_t> places_;
  std::vector<mesh::CellIndex> cells_;
  std::size_t cell_count_ = 0; ///< of the bulk
  std::vector<char> knows_;    ///< one a dof
  Eigen::VectorXd owned_;
  std::vector<int> everywhere_;          ///< dofs
  std::vector<int> halo_;                ///< dofs that cells of other ranks have, too
  std::vector<std::vector<int>> shared_; ///< dofs of each parcel, ascending
  // Room for what is sent:
  mutable std::vector<Parcel> parcels_; ///< by ascending ranks
  mutable std::vector<double> own_;
  mutable std::vector<double> of_all_;
};

/// Of each cell of the bulk: parts of about as many cells with few nodes in common (METIS), the same on all
/// ranks. Some get none where there are more ranks than cells.
std::vector<int> partition(const mesh::Mesh& mesh, const Bulk& bulk, const Ranks& ranks);

template <class SizeOf> void RankParts::clear_others(std::span<double> values, const SizeOf& size_of) const {
  std::size_t first = 0, next = 0;
  for (std::size_t place = 0; place < cell_count_; ++place) {
    const std::size_t size = size_of(place);
    if (next < places_.size() && places_[next] == place)
      ++next;
    else
      std::fill_n(values.begin() + static_cast<std::ptrdiff_t>(first), size, 0.0);
    first += size;
  }
}

} // namespace rubato::domain
