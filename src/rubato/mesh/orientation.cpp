// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/orientation.hpp"

#include "rubato/cell/parts.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;

/// Twice the area vector of the triangle or quadrangle of these corners.
Vector3d double_area(std::span<const Vector3d> corners) {
  return corners.size() == 3 ? Vector3d((corners[1] - corners[0]).cross(corners[2] - corners[0]))
                             : Vector3d((corners[2] - corners[0]).cross(corners[3] - corners[1]));
}

double six_volumes(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return a.dot(b.cross(c));
}

/// Six times the volume between the origin and an outward face. The bilinear face of a quadrangle encloses
/// the mean of what its two triangulations enclose.
double six_volumes_below(std::span<const Vector3d> x) {
  if (x.size() == 3)
    return six_volumes(x[0], x[1], x[2]);
  return (six_volumes(x[0], x[1], x[2]) + six_volumes(x[0], x[2], x[3]) + six_volumes(x[0], x[1], x[3]) +
          six_volumes(x[1], x[2], x[3])) /
         2;
}

double volume(const cell::CellTopology& shape, std::span<const Vector3d> corners) {
  double sum = 0;
  std::array<Vector3d, 4> face;
  for (const auto& side : shape.sides) {
    const auto count = static_cast<std::size_t>(cell::topology(side.type).corner_count);
    for (std::size_t i = 0; i < count; ++i)
      face[i] = corners[side.nodes[i]] - corners[0];
    sum += six_volumes_below(std::span(face).first(count));
  }
  return sum / 6;
}

/// Corners of the mirrored cell: the base runs the other way round from the same first corner.
std::vector<std::uint8_t> mirrored_corners(CellType linear) {
  switch (linear) {
  case CellType::seg2:
    return {1, 0};
  case CellType::tria3:
    return {0, 2, 1};
  case CellType::quad4:
    return {0, 3, 2, 1};
  case CellType::tetra4:
    return {0, 2, 1, 3};
  case CellType::pyra5:
    return {0, 3, 2, 1, 4};
  case CellType::penta6:
    return {0, 2, 1, 3, 5, 4};
  case CellType::hexa8:
    return {0, 3, 2, 1, 4, 7, 6, 5};
  default:
    return {0};
  }
}

bool same_set(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  return std::ranges::is_permutation(a, b);
}

std::vector<std::uint8_t> mirror_of(const cell::CellTopology& shape) {
  auto mirror = mirrored_corners(cell::linear_type(shape.type));
  const auto image = [&mirror](std::span<const std::uint8_t> corners) {
    std::vector<std::uint8_t> mirrored;
    for (const auto corner : corners)
      mirrored.push_back(mirror[corner]);
    return mirrored;
  };
  if (shape.order == 2)
    for (const auto& edge : shape.edges) {
      const auto ends = image(edge);
      const auto old = std::ranges::find_if(shape.edges, [&](const auto& e) { return same_set(e, ends); });
      const auto index = static_cast<std::size_t>(old - shape.edges.begin());
      mirror.push_back(static_cast<std::uint8_t>(cell::mid_node(shape, index)));
    }
  for (const auto& side : shape.sides) {
    if (!cell::centre_node(side))
      continue;
    const auto corners = image(side.nodes.first(4));
    const auto old = std::ranges::find_if(shape.sides, [&](const cell::CellSide& s) {
      return cell::centre_node(s).has_value() && same_set(s.nodes.first(4), corners);
    });
    mirror.push_back(static_cast<std::uint8_t>(*cell::centre_node(*old)));
  }
  if (const auto inner = cell::inner_node(shape))
    mirror.push_back(static_cast<std::uint8_t>(*inner));
  return mirror;
}

void mirror_cell(std::span<NodeIndex> nodes, std::span<const std::uint8_t> mirror) {
  std::array<NodeIndex, 27> before{};
  std::ranges::copy(nodes, before.begin());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = before[mirror[i]];
}

} // namespace

double signed_measure(const Mesh& mesh, CellIndex cell) {
  const auto place = mesh.place_of(cell);
  return signed_measure(place.block->type, place.block->cell(place.index), mesh.points, mesh.dimension);
}

double signed_measure(CellType type, std::span<const NodeIndex> nodes, const std::vector<Vector3d>& points,
                      int space_dimension) {
  const auto& shape = cell::topology(type);
  std::array<Vector3d, 8> storage;
  const auto count = static_cast<std::size_t>(shape.corner_count);
  for (std::size_t i = 0; i < count; ++i)
    storage[i] = points[static_cast<std::size_t>(nodes[i])];
  const auto corners = std::span<const Vector3d>(storage).first(count);
  switch (shape.dimension) {
  case 0:
    return 0;
  case 1:
    return (corners[1] - corners[0]).norm();
  case 2:
    return space_dimension == 2 ? double_area(corners).z() / 2 : double_area(corners).norm() / 2;
  default:
    return volume(shape, corners);
  }
}

std::span<const std::uint8_t> mirrored_numbering(CellType type) {
  static const auto tables = [] {
    std::vector<std::vector<std::uint8_t>> all;
    for (const auto& shape : cell::all_topologies())
      all.push_back(mirror_of(shape));
    return all;
  }();
  return tables[static_cast<std::size_t>(type)];
}

std::vector<CellIndex> mend_orientation(Mesh& mesh) {
  std::vector<CellIndex> mended;
  CellIndex first = 0;
  for (auto& block : mesh.blocks) {
    const auto first_of_block = std::exchange(first, first + block.cell_count());
    if (cell::topology(block.type).dimension != mesh.dimension)
      continue;
    const auto mirror = mirrored_numbering(block.type);
    for (CellIndex i = 0; i < block.cell_count(); ++i) {
      if (signed_measure(block.type, block.cell(i), mesh.points, mesh.dimension) >= 0)
        continue;
      mirror_cell(std::span(block.nodes).subspan(static_cast<std::size_t>(i) * mirror.size(), mirror.size()),
                  mirror);
      mended.push_back(first_of_block + i);
    }
  }
  return mended;
}

} // namespace rubato::mesh
