// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/vtk_grid.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/mesh/orientation.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace rubato::mesh {
namespace {

/// VTK's cell type numbers (vtkCellType.h), in the order of CellType.
constexpr std::array<std::uint8_t, 19> vtk_types{1,  3,  21, 5,  22, 34, 9,  23, 28, 10,
                                                 24, 14, 27, 13, 26, 32, 12, 25, 29};

std::vector<const CellBlock*> chosen_blocks(const Mesh& mesh, VtuCells which) {
  int highest = 0;
  for (const auto& block : mesh.blocks)
    highest = std::max(highest, cell::topology(block.type).dimension);
  std::vector<const CellBlock*> chosen;
  for (const auto& block : mesh.blocks)
    if (which == VtuCells::all || cell::topology(block.type).dimension == highest)
      chosen.push_back(&block);
  return chosen;
}

/// The nodes of a block as VTK orders them. The base of VTK's wedges, 0 1 2, turns so that its normal points
/// out of the cell (vtkWedge.h, vtkQuadraticWedge.h): our prism mirrored. So volumes are positive and faces
/// turn outward in VTK, quadratic wedges included; vtkCellValidator alone wants the faces of those inward.
/// All other cells are VTK's.
void append_in_vtk_order(const CellBlock& block, std::vector<std::int32_t>& nodes) {
  if (cell::linear_type(block.type) != CellType::penta6) {
    nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
    return;
  }
  const auto order = mirrored_numbering(block.type);
  for (CellIndex cell = 0; cell < block.cell_count(); ++cell)
    for (const auto local : order)
      nodes.push_back(block.cell(cell)[local]);
}

std::vector<std::int64_t> numbers_of(const std::vector<const CellBlock*>& blocks) {
  std::vector<std::int64_t> numbers;
  for (const auto* block : blocks) {
    if (block->numbers.size() != static_cast<std::size_t>(block->cell_count()))
      return {};
    numbers.insert(numbers.end(), block->numbers.begin(), block->numbers.end());
  }
  return numbers;
}

constexpr std::int64_t not_written = -1;

/// Of each cell of the mesh its place among those that are written.
std::vector<std::int64_t> places_of_cells(const Mesh& mesh, const VtkCells& cells) {
  std::vector<std::int64_t> places;
  std::int64_t next = 0;
  for (const auto& block : mesh.blocks) {
    const bool is_written = std::ranges::find(cells.blocks, &block) != cells.blocks.end();
    for (CellIndex i = 0; i < block.cell_count(); ++i)
      places.push_back(is_written ? next++ : not_written);
  }
  return places;
}

bool has_group(const std::vector<VtkGroup>& groups, const std::string& name) {
  return std::ranges::find(groups, name, &VtkGroup::name) != groups.end();
}

std::string array_name(const Group& group) {
  return std::string(vtk_group_prefix) + group.name;
}

/// Of the cells that are not written the nodes; whether there are any.
bool mark_nodes(const Mesh& mesh, const Group& group, const std::vector<std::int64_t>& places,
                std::vector<std::uint8_t>& members) {
  bool found = false;
  for (const auto cell : group.items) {
    if (places[static_cast<std::size_t>(cell)] != not_written)
      continue;
    found = true;
    for (const auto node : mesh.nodes_of(cell))
      members[static_cast<std::size_t>(node)] = 1;
  }
  return found;
}

bool mark_cells(const Group& group, const std::vector<std::int64_t>& places,
                std::vector<std::uint8_t>& members) {
  bool found = false;
  for (const auto cell : group.items)
    if (const auto place = places[static_cast<std::size_t>(cell)]; place != not_written) {
      found = true;
      members[static_cast<std::size_t>(place)] = 1;
    }
  return found;
}

constexpr int mantissa_bits = std::numeric_limits<double>::digits - 1;

/// The nearest number whose last `dropped` bits are 0. Infinite and other numbers that are none stay.
double rounded(double value, int dropped) {
  if (!std::isfinite(value))
    return value;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t unit = std::uint64_t{1} << dropped;
  const double near = std::bit_cast<double>((bits + unit / 2) & ~(unit - 1));
  return std::isfinite(near) ? near : value;
}

} // namespace

VtkCells vtk_cells(const Mesh& mesh, VtuCells which) {
  VtkCells cells{chosen_blocks(mesh, which), {}, {}, {}, {}};
  for (const auto* block : cells.blocks) {
    append_in_vtk_order(*block, cells.connectivity);
    cells.types.insert(cells.types.end(), static_cast<std::size_t>(block->cell_count()),
                       vtk_types[static_cast<std::size_t>(block->type)]);
    for (CellIndex cell = 0; cell < block->cell_count(); ++cell)
      cells.ends.push_back((cells.ends.empty() ? 0 : cells.ends.back()) +
                           cell::topology(block->type).node_count);
  }
  cells.numbers = numbers_of(cells.blocks);
  return cells;
}

VtkGroups vtk_groups(const Mesh& mesh, const VtkCells& cells) {
  const auto places = places_of_cells(mesh, cells);
  VtkGroups groups;
  for (const auto& group : mesh.node_groups) {
    groups.of_points.push_back({array_name(group), std::vector<std::uint8_t>(mesh.points.size(), 0)});
    for (const auto node : group.items)
      groups.of_points.back().members[static_cast<std::size_t>(node)] = 1;
  }
  for (const auto& group : mesh.cell_groups) {
    VtkGroup in_cells{array_name(group), std::vector<std::uint8_t>(cells.types.size(), 0)};
    if (mark_cells(group, places, in_cells.members))
      groups.of_cells.push_back(std::move(in_cells));
    VtkGroup in_points{array_name(group), std::vector<std::uint8_t>(mesh.points.size(), 0)};
    if (!has_group(groups.of_points, in_points.name) && mark_nodes(mesh, group, places, in_points.members))
      groups.of_points.push_back(std::move(in_points));
  }
  return groups;
}

std::vector<double> with_digits(std::span<const double> values, int digits) {
  std::vector<double> kept(values.begin(), values.end());
  const int needed = static_cast<int>(std::ceil(digits * std::log2(10.0)));
  if (needed >= mantissa_bits)
    return kept;
  for (auto& value : kept)
    value = rounded(value, mantissa_bits - needed);
  return kept;
}

std::optional<CellType> cell_type_of_vtk(int number) {
  const auto* const found = std::ranges::find(vtk_types, number);
  if (found == vtk_types.end())
    return std::nullopt;
  return static_cast<CellType>(found - vtk_types.begin());
}

std::vector<NodeIndex> from_vtk_order(CellType type, std::span<const NodeIndex> nodes) {
  std::vector<NodeIndex> ordered(nodes.begin(), nodes.end());
  if (cell::linear_type(type) == CellType::penta6) {
    const auto order = mirrored_numbering(type); // its own inverse
    std::ranges::transform(order, ordered.begin(), [&](auto local) { return nodes[local]; });
  }
  return ordered;
}

} // namespace rubato::mesh
