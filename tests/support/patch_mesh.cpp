// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/patch_mesh.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/topology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <utility>

namespace rubato::test {

CellType corner_type(const cell::CellTopology& cell) {
  const auto same_shape = [&](const cell::CellTopology& other) {
    return other.order == 1 && other.dimension == cell.dimension && other.corner_count == cell.corner_count;
  };
  return std::ranges::find_if(cell::all_topologies(), same_shape)->type;
}

namespace {

/// Corner lists of the simplices, pyramids, prisms or boxes that fill one box of a grid; `box` holds its 4 or
/// 8 corners in the order of QUAD4 or HEXA8 and, for pyramids, a node inside.
std::vector<Corners> pieces_of_box(const cell::CellTopology& cell, const Corners& box) {
  using Pieces = std::vector<std::vector<std::size_t>>;
  Pieces pieces;
  if (cell.corner_count == static_cast<int>(box.size()))
    return {box};
  if (cell.dimension == 2)
    pieces = {{0, 1, 2}, {0, 2, 3}};
  else if (cell.corner_count == 5)
    pieces = {{0, 1, 2, 3, 8}, {4, 7, 6, 5, 8}, {0, 4, 5, 1, 8},
              {1, 5, 6, 2, 8}, {2, 6, 7, 3, 8}, {3, 7, 4, 0, 8}};
  else if (cell.corner_count == 6)
    pieces = {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
  else // the six paths from corner 0 to corner 6 along the edges (H. W. Kuhn)
    pieces = {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
  std::vector<Corners> result;
  for (const auto& piece : pieces) {
    auto& corners = result.emplace_back();
    for (const auto i : piece)
      corners.push_back(box[i]);
  }
  return result;
}

} // namespace

PatchBuilder::PatchBuilder(CellType type) : cell_(cell::reference_cell(type)) {
  mesh_.dimension = cell_.dimension;
  mesh_.blocks.emplace_back().type = type;
}

mesh::NodeIndex PatchBuilder::add_node(const Eigen::Vector3d& point) {
  mesh_.points.push_back(point);
  mesh_.node_numbers.push_back(static_cast<std::int64_t>(mesh_.points.size()));
  return mesh_.node_count() - 1;
}

void PatchBuilder::add_cell(const Corners& corners) {
  const auto& linear = cell::reference_cell(corner_type(cell::topology(cell_.type)));
  auto& block = mesh_.blocks.front();
  std::vector<double> share(corners.size());
  for (const auto& xi : cell_.nodes) {
    linear.values(xi, share);
    block.nodes.push_back(node_between(corners, share));
  }
  block.numbers.push_back(block.cell_count());
}

mesh::NodeIndex PatchBuilder::node_between(const Corners& corners, const std::vector<double>& share) {
  Corners key;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (share[i] > 1e-12) {
      key.push_back(corners[i]);
      point += share[i] * mesh_.points[static_cast<std::size_t>(corners[i])];
    }
  if (key.size() == 1)
    return key.front();
  std::ranges::sort(key);
  const auto [place, is_new] = between_.try_emplace(key, mesh_.node_count());
  if (is_new)
    add_node(point);
  return place->second;
}

mesh::Mesh patch_mesh(CellType type, int n, const Map& map) {
  const auto& cell = cell::topology(type);
  const bool solid = cell.dimension == 3;
  PatchBuilder builder(type);
  for (int k = 0; k <= (solid ? n : 0); ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        builder.add_node(map(Eigen::Vector3d(i, j, k) / n));
  const auto corner = [n](int i, int j, int k) { return i + (n + 1) * (j + (n + 1) * k); };
  for (int k = 0; k < (solid ? n : 1); ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        Corners box{corner(i, j, k), corner(i + 1, j, k), corner(i + 1, j + 1, k), corner(i, j + 1, k)};
        if (solid)
          for (std::size_t c = 0; c < 4; ++c)
            box.push_back(box[c] + corner(0, 0, 1));
        if (cell.corner_count == 5)
          box.push_back(builder.add_node(map(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5) / n)));
        for (const auto& corners : pieces_of_box(cell, box))
          builder.add_cell(corners);
      }
  return std::move(builder).mesh();
}

Map shaken(int dimension, int n, double amount) {
  return [=](const Eigen::Vector3d& x) {
    const Eigen::Vector3d cell = (x * n).array().round();
    std::seed_seq seed{static_cast<int>(cell[0]), static_cast<int>(cell[1]), static_cast<int>(cell[2])};
    std::mt19937 engine(seed);
    Eigen::Vector3d moved = x;
    for (int a = 0; a < dimension; ++a)
      if (x[a] > 1e-9 && x[a] < 1 - 1e-9)
        moved[a] += amount / n * (2. * static_cast<double>(engine() % 1000) / 999. - 1.);
    return moved;
  };
}

Map moved_by(const Map& map, const Eigen::Vector3d& shift) {
  return [=](const Eigen::Vector3d& x) -> Eigen::Vector3d { return map(x) + shift; };
}

std::vector<BoundarySide> boundary_sides(const mesh::Mesh& mesh) {
  std::map<Corners, std::pair<int, BoundarySide>> seen;
  const auto& block = mesh.blocks.front();
  for (mesh::CellIndex cell = 0; cell < block.cell_count(); ++cell)
    for (const auto& side : cell::topology(block.type).sides) {
      BoundarySide face{side.type, {}};
      for (const auto local : side.nodes)
        face.nodes.push_back(block.cell(cell)[local]);
      Corners key = face.nodes;
      std::ranges::sort(key);
      auto& entry = seen[key];
      ++entry.first;
      entry.second = face;
    }
  std::vector<BoundarySide> sides;
  for (const auto& [key, entry] : seen)
    if (entry.first == 1)
      sides.push_back(entry.second);
  return sides;
}

std::vector<bool> boundary_nodes(const mesh::Mesh& mesh) {
  std::vector<bool> on(mesh.points.size(), false);
  for (const auto& side : boundary_sides(mesh))
    for (const auto node : side.nodes)
      on[static_cast<std::size_t>(node)] = true;
  return on;
}

domain::Bulk whole_bulk(const mesh::Mesh& mesh, const element::Section& section, const material::Law& law) {
  domain::Bulk bulk{
      section, std::vector<mesh::CellIndex>(static_cast<std::size_t>(mesh.cell_count())), {law}, {}};
  std::iota(bulk.cells.begin(), bulk.cells.end(), 0);
  bulk.law_of_cell.assign(bulk.cells.size(), 0);
  return bulk;
}

} // namespace rubato::test
