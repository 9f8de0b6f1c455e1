// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/rank_parts.hpp"

#include "rubato/core/index.hpp"

#include <algorithm>
#include <metis.h>
#include <utility>

namespace rubato::domain {
namespace {

using Eigen::VectorXd;
using mesh::NodeIndex;

/// Those with cells at it, ascending; none of nodes without cells.
std::vector<std::vector<int>> ranks_of_nodes(const mesh::Mesh& mesh, const Bulk& bulk,
                                             std::span<const int> rank_of_cell) {
  std::vector<std::vector<int>> found(mesh.points.size());
  for (std::size_t place = 0; place < bulk.cells.size(); ++place)
    for (const auto node : mesh.nodes_of(bulk.cells[place]))
      if (auto& ranks = found[at(node)]; std::ranges::find(ranks, rank_of_cell[place]) == ranks.end())
        ranks.push_back(rank_of_cell[place]);
  for (auto& ranks : found)
    std::ranges::sort(ranks);
  return found;
}

/// METIS leaves the whole of very small meshes to one part, and divides by zero for one part alone.
std::vector<int> by_place(std::size_t cells, int ranks) {
  std::vector<int> rank_of_cell(cells);
  for (std::size_t place = 0; place < cells; ++place)
    rank_of_cell[place] = static_cast<int>(place * static_cast<std::size_t>(ranks) / cells);
  return rank_of_cell;
}

std::vector<int> by_metis(const mesh::Mesh& mesh, const Bulk& bulk, int ranks) {
  std::vector<idx_t> starts{0}, nodes;
  for (const auto cell : bulk.cells) {
    for (const auto node : mesh.nodes_of(cell))
      nodes.push_back(static_cast<idx_t>(node));
    starts.push_back(static_cast<idx_t>(nodes.size()));
  }
  auto cells = static_cast<idx_t>(bulk.cells.size()), all_nodes = static_cast<idx_t>(mesh.points.size());
  idx_t nodes_of_face = mesh.dimension == 3 ? 3 : 2, parts = ranks, cut = 0;
  std::vector<idx_t> part_of_cell(bulk.cells.size()), part_of_node(mesh.points.size());
  std::vector<idx_t> options(METIS_NOPTIONS);
  METIS_SetDefaultOptions(options.data());
  const int status =
      METIS_PartMeshDual(&cells, &all_nodes, starts.data(), nodes.data(), nullptr, nullptr, &nodes_of_face,
                         &parts, nullptr, options.data(), &cut, part_of_cell.data(), part_of_node.data());
  if (status != METIS_OK)
    return by_place(bulk.cells.size(), ranks);
  return {part_of_cell.begin(), part_of_cell.end()};
}

} // namespace

std::vector<int> partition(const mesh::Mesh& mesh, const Bulk& bulk, const Ranks& ranks) {
  constexpr std::size_t fewest_a_rank = 8;
  std::vector<int> rank_of_cell(bulk.cells.size());
  if (ranks.is_first())
    rank_of_cell =
        ranks.is_alone() || bulk.cells.size() < fewest_a_rank * static_cast<std::size_t>(ranks.count())
            ? by_place(bulk.cells.size(), ranks.count())
            : by_metis(mesh, bulk, ranks.count());
  if (ranks.channel())
    ranks.channel()->broadcast(std::as_writable_bytes(std::span(rank_of_cell)));
  return rank_of_cell;
}

RankParts::RankParts(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                     std::span<const int> rank_of_cell, std::span<const NodeIndex> everywhere,
                     const Ranks& ranks)
    : ranks_(ranks), cell_count_(bulk.cells.size()), knows_(at(dofs.dof_count), 0),
      owned_(VectorXd::Zero(dofs.dof_count)) {
  for (std::size_t place = 0; place < cell_count_; ++place)
    if (rank_of_cell[place] == ranks_.index()) {
      places_.push_back(place);
      cells_.push_back(bulk.cells[place]);
    }
  const auto ranks_of_node = ranks_of_nodes(mesh, bulk, rank_of_cell);
  const auto know = [&](std::size_t node, bool owns) {
    for (int i = 0; i < dofs.components; ++i) {
      const int dof = dofs.dof(static_cast<NodeIndex>(node), i);
      knows_[at(dof)] = 1;
      owned_[dof] = owns ? 1 : 0;
    }
  };
  for (std::size_t node = 0; node < ranks_of_node.size(); ++node)
    if (const auto& those = ranks_of_node[node]; std::ranges::find(those, ranks_.index()) != those.end())
      know(node, those.front() == ranks_.index());
  for (const auto node : everywhere) {
    const auto& those = ranks_of_node[at(node)];
    know(at(node), !those.empty() && those.front() == ranks_.index());
    for (int i = 0; i < dofs.components; ++i)
      everywhere_.push_back(dofs.dof(node, i));
  }
  find_halo(ranks_of_node, dofs);
}

void RankParts::find_halo(const std::vector<std::vector<int>>& ranks_of_node, const DofMap& dofs) {
  shared_.resize(at(ranks_.count()));
  for (std::size_t node = 0; node < ranks_of_node.size(); ++node) {
    const auto& those = ranks_of_node[node];
    if (those.size() < 2 || std::ranges::find(those, ranks_.index()) == those.end())
      continue;
    for (int i = 0; i < dofs.components; ++i) {
      const int dof = dofs.dof(static_cast<NodeIndex>(node), i);
      halo_.push_back(dof);
      for (const int rank : those)
        if (rank != ranks_.index())
          shared_[at(rank)].push_back(dof);
    }
  }
  for (int rank = 0; rank < ranks_.count(); ++rank)
    if (const auto size = shared_[at(rank)].size(); size > 0)
      parcels_.push_back({rank, std::vector<double>(size), std::vector<double>(size)});
  std::erase_if(shared_, [](const auto& dofs_of_rank) { return dofs_of_rank.empty(); });
  own_.resize(halo_.size());
  of_all_.resize(everywhere_.size() + 1);
}

int RankParts::add_up(VectorXd& sum, bool raised) const {
  if (!ranks_.channel())
    return raised ? 1 : 0;
  for (std::size_t p = 0; p < parcels_.size(); ++p)
    for (std::size_t i = 0; i < shared_[p].size(); ++i)
      parcels_[p].sent[i] = sum[shared_[p][i]];
  ranks_.channel()->exchange(parcels_);
  for (std::size_t i = 0; i < halo_.size(); ++i)
    own_[i] = std::exchange(sum[halo_[i]], 0.0);
  const auto add = [&](std::size_t p) {
    for (std::size_t i = 0; i < shared_[p].size(); ++i)
      sum[shared_[p][i]] += parcels_[p].received[i];
  };
  std::size_t next = 0;
  for (; next < parcels_.size() && parcels_[next].rank < ranks_.index(); ++next)
    add(next);
  for (std::size_t i = 0; i < halo_.size(); ++i)
    sum[halo_[i]] += own_[i];
  for (; next < parcels_.size(); ++next)
    add(next);
  for (std::size_t i = 0; i < everywhere_.size(); ++i)
    of_all_[i] = owned_[everywhere_[i]] != 0 ? sum[everywhere_[i]] : 0;
  of_all_.back() = raised ? 1 : 0;
  ranks_.sum(of_all_);
  for (std::size_t i = 0; i < everywhere_.size(); ++i)
    sum[everywhere_[i]] = of_all_[i];
  return static_cast<int>(of_all_.back());
}

void RankParts::make_whole(VectorXd& values) const {
  for (Eigen::Index dof = 0; dof < values.size(); ++dof)
    if (owned_[dof] == 0)
      values[dof] = 0;
  ranks_.sum({values.data(), static_cast<std::size_t>(values.size())});
}

std::size_t RankParts::halo_size() const {
  std::size_t size = 0;
  for (const auto& parcel : parcels_)
    size += parcel.sent.size();
  return size;
}

} // namespace rubato::domain
