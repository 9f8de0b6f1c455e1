// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/work_shares.hpp"

#include "rubato/core/spatial_order.hpp"

#include <algorithm>
#include <numeric>

namespace rubato::domain {
namespace {

Eigen::Vector3d mean_of_nodes(const mesh::Mesh& mesh, mesh::CellIndex cell) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const auto nodes = mesh.nodes_of(cell);
  for (const auto node : nodes)
    sum += mesh.points[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

std::vector<Eigen::Vector3d> middles_of(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells,
                                        const Threads& threads) {
  std::vector<Eigen::Vector3d> middles(cells.size());
  threads.each_range(cells.size(), WorkShares::smallest, [&](std::size_t first, std::size_t last) {
    for (auto i = first; i < last; ++i)
      middles[i] = mean_of_nodes(mesh, cells[i]);
  });
  return middles;
}

} // namespace

WorkShares::WorkShares(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells, const Threads& threads)
    : threads_(threads), places_(cells.size()) {
  const auto parts = static_cast<std::size_t>(threads.parts_of(cells.size(), smallest));
  if (parts < 2) {
    std::iota(places_.begin(), places_.end(), 0U);
    starts_ = {0, cells.size()};
    return;
  }
  starts_.clear();
  const auto together = (cells.size() + parts - 1) / parts;
  const auto order = spatial_order(middles_of(mesh, cells, threads), together);
  std::ranges::transform(order, places_.begin(), [](std::size_t i) { return static_cast<std::uint32_t>(i); });
  for (std::size_t start = 0; start < cells.size(); start += together)
    starts_.push_back(start);
  starts_.push_back(cells.size());
  find_border(mesh, cells);
}

void WorkShares::find_border(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells) {
  constexpr int nobody = -1;
  std::vector<int> share_of_node(mesh.points.size(), nobody);
  shared_.assign(mesh.points.size(), 0);
  const auto nodes_of = [&](std::uint32_t place) { return mesh.nodes_of(cells[place]); };
  for (int share = 0; share < count(); ++share)
    for (const auto place : of(share))
      for (const auto node : nodes_of(place)) {
        auto& owner = share_of_node[static_cast<std::size_t>(node)];
        if (owner == nobody)
          owner = share;
        else if (owner != share)
          shared_[static_cast<std::size_t>(node)] = 1;
      }
  in_border_.assign(cells.size(), -1);
  for (std::uint32_t place = 0; place < cells.size(); ++place)
    if (std::ranges::any_of(nodes_of(place), [&](auto node) { return is_shared(node); })) {
      in_border_[place] = static_cast<std::int32_t>(border_.size());
      border_.push_back(place);
    }
}

void WorkShares::rethrow_first(std::span<const Thrown> thrown) {
  const Thrown* first = nullptr;
  for (const auto& one : thrown)
    if (one.what && (first == nullptr || one.cell < first->cell))
      first = &one;
  if (first != nullptr)
    std::rethrow_exception(first->what);
}

} // namespace rubato::domain
