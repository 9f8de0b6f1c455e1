// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/corner_sets.hpp"

#include <algorithm>

namespace rubato::mesh {

CornerSet corner_set(std::span<const NodeIndex> corners) {
  CornerSet set{-1, -1, -1, -1};
  const auto end = std::ranges::copy(corners, set.begin()).out;
  // By insertion: of four there is nothing to be gained by more, and nothing for GCC to warn about.
  for (auto* place = set.begin(); place != end; ++place)
    std::rotate(std::upper_bound(set.begin(), place, *place), place, place + 1);
  return set;
}

CornerSet corner_set(std::span<const NodeIndex> cell_nodes, const cell::CellSide& side) {
  CornerSet corners{};
  const auto count = static_cast<std::size_t>(cell::topology(side.type).corner_count);
  for (std::size_t i = 0; i < count; ++i)
    corners[i] = cell_nodes[side.nodes[i]];
  return corner_set(std::span(corners).first(count));
}

CornerSet corner_set(std::span<const NodeIndex> cell_nodes, const std::array<std::uint8_t, 2>& edge) {
  const auto [low, high] = std::minmax(cell_nodes[edge[0]], cell_nodes[edge[1]]);
  return {low, high, -1, -1};
}

std::int32_t CornerSets::insert(const CornerSet& corners) {
  if (const auto known = find(corners); known != none)
    return known;
  const auto smallest = static_cast<std::size_t>(corners[0]);
  if (smallest >= first_.size())
    first_.resize(std::max(smallest + 1, 2 * first_.size()), none);
  const auto number = size();
  entries_.push_back({corners, first_[smallest]});
  first_[smallest] = number;
  return number;
}

std::int32_t CornerSets::find(const CornerSet& corners) const {
  const auto smallest = static_cast<std::size_t>(corners[0]);
  if (smallest >= first_.size())
    return none;
  auto number = first_[smallest];
  while (number != none && entries_[static_cast<std::size_t>(number)].corners != corners)
    number = entries_[static_cast<std::size_t>(number)].next;
  return number;
}

NodeIndex& SharedNodes::operator[](const CornerSet& corners) {
  const auto number = static_cast<std::size_t>(sets_.insert(corners));
  if (number == nodes_.size())
    nodes_.push_back(none);
  return nodes_[number];
}

} // namespace rubato::mesh
