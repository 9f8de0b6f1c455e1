// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/embedding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace rubato::model {

using mesh::CellIndex;

std::string of_group(const std::string& name) {
  return name.empty() ? "" : fmt::format(" of group '{}'", name);
}

std::vector<CellIndex> host_cells(const mesh::Mesh& mesh, int dimension, const Mention& group,
                                  std::vector<Fault>& faults) {
  std::vector<CellIndex> cells;
  if (group.name.empty()) {
    cells.resize(static_cast<std::size_t>(mesh.cell_count()));
    std::iota(cells.begin(), cells.end(), CellIndex{0});
  } else if (const auto* named = cells_named(mesh, group, faults)) {
    cells = named->items;
  } else {
    return cells;
  }
  std::erase_if(cells,
                [&](CellIndex cell) { return cell::topology(mesh.type_of(cell)).dimension != dimension; });
  if (cells.empty())
    faults.push_back(fault_at(group.path, fmt::format("group '{}' holds no cells that deform", group.name)));
  return cells;
}

std::optional<mesh::CellShare> cell_at(const mesh::PlaceFinder& finder, const Eigen::Vector3d& place,
                                       mesh::NodeIndex except) {
  for (auto& share : finder.cells_at(place))
    if (std::ranges::find(share.nodes, except) == share.nodes.end())
      return std::move(share);
  return std::nullopt;
}

} // namespace rubato::model
