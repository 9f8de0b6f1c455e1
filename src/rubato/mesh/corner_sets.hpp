// SPDX-License-Identifier: LGPL-3.0-or-later
/// Edges and sides recognised by their corner nodes. Two bodies whose nodes coincide in space but are
/// distinct share no corner, so nothing of theirs is ever taken for the same edge or side.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rubato::mesh {

/// One to four nodes, whatever their order: ascending, then filled up with −1.
using CornerSet = std::array<NodeIndex, 4>;

CornerSet corner_set(std::span<const NodeIndex> corners);
/// The corners of a side of the cell with these nodes.
CornerSet corner_set(std::span<const NodeIndex> cell_nodes, const cell::CellSide& side);
/// The ends of an edge of the cell with these nodes.
CornerSet corner_set(std::span<const NodeIndex> cell_nodes, const std::array<std::uint8_t, 2>& edge);

/// Numbers corner sets 0, 1, 2… in the order in which they are first seen. A hash table whose hash is the
/// smallest node: the few sets that share it stand in one short chain.
class CornerSets {
public:
  static constexpr std::int32_t none = -1;

  /// The number of the set, a new one when it was never seen.
  std::int32_t insert(const CornerSet& corners);
  /// The number of the set, `none` when it was never seen.
  std::int32_t find(const CornerSet& corners) const;
  std::int32_t size() const { return static_cast<std::int32_t>(entries_.size()); }

private:
  struct Entry {
    CornerSet corners;
    std::int32_t next;
  };
  std::vector<std::int32_t> first_; // by smallest node
  std::vector<Entry> entries_;
};

/// A node for each corner set: the middle of that edge, the centre of that side.
class SharedNodes {
public:
  static constexpr NodeIndex none = -1;

  /// The node of the set, to be read or written; `none` until it is written.
  NodeIndex& operator[](const CornerSet& corners);

private:
  CornerSets sets_;
  std::vector<NodeIndex> nodes_;
};

} // namespace rubato::mesh
