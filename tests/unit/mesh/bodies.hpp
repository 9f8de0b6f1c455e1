// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies and measures that the tests of the mesh module share.
#pragma once

#include "rubato/cell/parts.hpp"
#include "rubato/mesh/corner_sets.hpp"
#include "rubato/mesh/generate.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/study/study.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace rubato::test {

inline const std::vector<CellType> plane_types{CellType::tria3, CellType::tria6, CellType::tria7,
                                               CellType::quad4, CellType::quad8, CellType::quad9};
inline const std::vector<CellType> solid_types{CellType::tetra4,  CellType::tetra10, CellType::penta6,
                                               CellType::penta15, CellType::hexa8,   CellType::hexa20,
                                               CellType::hexa27};

inline std::vector<CellType> all_types() {
  auto types = plane_types;
  types.insert(types.end(), solid_types.begin(), solid_types.end());
  return types;
}

/// [0, 2] × [0, 1] (× [0, 3]) in 2 × 3 (× 2) divisions with every side, one edge and one corner named.
inline study::Body body_of(CellType type) {
  study::Body body;
  body.name = "body";
  body.dimension = cell::topology(type).dimension;
  body.to = {2, 1, 3};
  body.divisions = {2, 3, 2};
  body.cells = type;
  for (const char* side : {"left", "right", "bottom", "top"})
    body.sides[side] = side;
  if (body.dimension == 3) {
    body.sides["back"] = "back";
    body.sides["front"] = "front";
    body.edges["right_top"] = "rim";
    body.points["right_top_front"] = "tip";
  } else {
    body.points["right_top"] = "tip";
  }
  return body;
}

inline mesh::Mesh mesh_of(CellType type, int refine = 1) {
  const auto body = body_of(type);
  return mesh::generate({&body, 1}, refine);
}

/// Two beams [0,1] × [−0.1,0] and [0,1] × [0,0.1] (× [0,0.1]) that touch with coincident, distinct nodes.
inline std::vector<study::Body> two_beams(CellType type) {
  study::Body lower;
  lower.name = "lower";
  lower.dimension = cell::topology(type).dimension;
  lower.from = {0, -0.1, 0};
  lower.to = {1, 0, 0.1};
  lower.divisions = {20, 2, 1};
  lower.cells = type;
  lower.sides = {{"left", "clamped"}, {"top", "slave"}};
  auto upper = lower;
  upper.name = "upper";
  upper.from = {0, 0, 0};
  upper.to = {1, 0.1, 0.1};
  upper.sides = {{"left", "clamped"}, {"bottom", "master"}};
  return {lower, upper};
}

/// Measure of all bulk cells; every one must be positive for the sum to be returned.
inline double bulk_measure(const mesh::Mesh& mesh) {
  double sum = 0;
  for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
    if (cell::topology(mesh.type_of(cell)).dimension == mesh.dimension) {
      const double measure = signed_measure(mesh, cell);
      if (!(measure > 0))
        return std::nan("");
      sum += measure;
    }
  return sum;
}

inline double group_measure(const mesh::Mesh& mesh, const std::string& name) {
  const auto* group = mesh.cell_group(name);
  if (group == nullptr)
    return std::nan("");
  return std::accumulate(group->items.begin(), group->items.end(), 0.,
                         [&](double sum, mesh::CellIndex cell) { return sum + signed_measure(mesh, cell); });
}

inline mesh::CellIndex count_of(const mesh::Mesh& mesh, CellType type) {
  for (const auto& block : mesh.blocks)
    if (block.type == type)
      return block.cell_count();
  return 0;
}

/// How often each side of the bulk cells occurs: index 0 once, 1 twice, 2 more often.
inline std::vector<int> side_multiplicities(const mesh::Mesh& mesh) {
  mesh::CornerSets sides;
  std::vector<int> counts;
  for_each_cell(
      mesh, [&](mesh::CellIndex, const cell::CellTopology& shape, std::span<const mesh::NodeIndex> nodes) {
        if (shape.dimension != mesh.dimension)
          return;
        for (const auto& side : shape.sides) {
          const auto number = static_cast<std::size_t>(sides.insert(mesh::corner_set(nodes, side)));
          counts.resize(std::max(counts.size(), number + 1), 0);
          ++counts[number];
        }
      });
  std::vector<int> multiplicities(3, 0);
  for (const int count : counts)
    ++multiplicities[static_cast<std::size_t>(std::min(count, 3) - 1)];
  return multiplicities;
}

/// The number of nodes that no cell uses.
inline int free_node_count(const mesh::Mesh& mesh) {
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& block : mesh.blocks)
    for (const auto node : block.nodes)
      used[static_cast<std::size_t>(node)] = true;
  return static_cast<int>(std::ranges::count(used, false));
}

} // namespace rubato::test
