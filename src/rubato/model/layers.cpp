// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/layers.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/mesh/corner_sets.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rubato::model {
namespace {

using mesh::CellIndex;

constexpr std::int32_t none = -1;
constexpr std::size_t most_sides = 6;
constexpr std::size_t most_directions = most_sides / 2;

/// A side of a cell: its place in `bulk.cells`, and which side.
struct Side {
  std::int32_t cell = none;
  std::uint32_t side = 0;
};

bool has_rows(CellType type) {
  return type == CellType::quad4 || type == CellType::hexa8;
}

bool share_a_node(const cell::CellSide& one, const cell::CellSide& other) {
  for (const auto a : one.nodes)
    for (const auto b : other.nodes)
      if (a == b)
        return true;
  return false;
}

/// Pairs of sides without a common node; `direction` of a side is the number of its pair.
struct OppositeSides {
  std::array<std::uint32_t, most_sides> other{};
  std::array<std::uint32_t, most_sides> direction{};
  std::array<std::uint32_t, most_directions> first{};
};

OppositeSides opposite_sides(CellType type) {
  const auto sides = cell::topology(type).sides;
  OppositeSides found;
  std::uint32_t directions = 0;
  for (std::uint32_t a = 0; a < sides.size(); ++a)
    for (std::uint32_t b = a + 1; b < sides.size(); ++b)
      if (!share_a_node(sides[a], sides[b])) {
        found.other.at(a) = b;
        found.other.at(b) = a;
        found.first.at(directions) = a;
        found.direction.at(a) = found.direction.at(b) = directions++;
      }
  return found;
}

/// What a cell is asked for again and again.
struct RowCell {
  CellType type;
  std::span<const mesh::NodeIndex> nodes;
};

std::vector<RowCell> row_cells(const mesh::Mesh& mesh, std::span<const CellIndex> cells) {
  std::vector<RowCell> found;
  found.reserve(cells.size());
  for (const auto cell : cells) {
    const auto place = mesh.place_of(cell);
    found.push_back({place.block->type, place.block->cell(place.index)});
  }
  return found;
}

/// A row of cells through opposite sides.
struct Row {
  int count = 0;
  double length = 0;
  bool known = true; ///< it meets no cell of another shape
};

/// Rows of all cells, each walked once.
class Rows {
public:
  Rows(const mesh::Mesh& mesh, const domain::Bulk& bulk)
      : mesh_(mesh), cells_(row_cells(mesh, bulk.cells)), row_of_(cells_.size() * most_directions, none) {
    collect_sides();
    for (std::size_t cell = 0; cell < cells_.size(); ++cell)
      if (has_rows(type_of(cell)))
        for (std::uint32_t direction = 0; direction < directions_of(cell); ++direction)
          if (row_of(cell, direction) == none)
            walk(cell, direction);
  }

  Layers layers_of(std::size_t cell) const {
    Layers layers;
    if (!has_rows(type_of(cell)))
      return layers;
    for (std::uint32_t direction = 0; direction < directions_of(cell); ++direction) {
      const auto& row = rows_[static_cast<std::size_t>(row_of(cell, direction))];
      if (!row.known)
        return {};
      layers.length = std::max(layers.length, row.length);
      if (layers.count == 0 || row.length < layers.thickness) {
        layers.count = row.count;
        layers.thickness = row.length;
        layers.across = across(cell, direction);
      }
    }
    return layers;
  }

private:
  CellType type_of(std::size_t cell) const { return cells_[cell].type; }
  std::size_t directions_of(std::size_t cell) const { return cell::topology(type_of(cell)).sides.size() / 2; }
  const OppositeSides& opposite(std::size_t cell) const {
    return type_of(cell) == CellType::quad4 ? of_quad4_ : of_hexa8_;
  }
  std::int32_t& row_of(std::size_t cell, std::uint32_t direction) {
    return row_of_[cell * most_directions + direction];
  }
  std::int32_t row_of(std::size_t cell, std::uint32_t direction) const {
    return row_of_[cell * most_directions + direction];
  }

  mesh::CornerSet corners(std::size_t cell, std::uint32_t side) const {
    return mesh::corner_set(cells_[cell].nodes, cell::topology(type_of(cell)).sides[side]);
  }

  /// Both cells at each side.
  void collect_sides() {
    for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
      const auto count = cell::topology(type_of(cell)).sides.size();
      for (std::uint32_t side = 0; side < count; ++side) {
        const auto number = static_cast<std::size_t>(sets_.insert(corners(cell, side)));
        if (number == cells_at_.size())
          cells_at_.emplace_back();
        auto& [one, other] = cells_at_[number];
        (one.cell == none ? one : other) = {static_cast<std::int32_t>(cell), side};
      }
    }
  }

  /// What is beyond a side; no cell at the surface.
  Side beyond(std::size_t cell, std::uint32_t side) const {
    const auto& [one, other] = cells_at_[static_cast<std::size_t>(sets_.find(corners(cell, side)))];
    return one.cell == static_cast<std::int32_t>(cell) ? other : one;
  }

  Eigen::Vector3d centre(std::size_t cell, std::uint32_t side) const {
    const auto nodes = cells_[cell].nodes;
    const auto& own = cell::topology(type_of(cell)).sides[side].nodes;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto local : own)
      contact::add_scaled(1, mesh_.points[static_cast<std::size_t>(nodes[local])], sum);
    for (auto& value : sum)
      value /= static_cast<double>(own.size());
    return sum;
  }

  /// Between the centres of both sides.
  Eigen::Vector3d across(std::size_t cell, std::uint32_t direction) const {
    const auto first = opposite(cell).first.at(direction);
    return contact::difference_of(centre(cell, opposite(cell).other.at(first)), centre(cell, first));
  }

  void take(std::size_t cell, std::uint32_t direction, Row& row) {
    row_of(cell, direction) = static_cast<std::int32_t>(rows_.size());
    row.length += contact::length_of(across(cell, direction));
    ++row.count;
  }

  /// On from a side until the surface, a cell of another shape, or a cell of the row itself.
  void follow(std::size_t cell, std::uint32_t out, Row& row) {
    for (;;) {
      const auto [next, in] = beyond(cell, out);
      if (next == none)
        return;
      cell = static_cast<std::size_t>(next);
      if (!has_rows(type_of(cell))) {
        row.known = false;
        return;
      }
      const auto direction = opposite(cell).direction.at(in);
      if (row_of(cell, direction) != none)
        return;
      take(cell, direction, row);
      out = opposite(cell).other.at(in);
    }
  }

  void walk(std::size_t cell, std::uint32_t direction) {
    Row row;
    const auto first = opposite(cell).first.at(direction);
    take(cell, direction, row);
    follow(cell, first, row);
    follow(cell, opposite(cell).other.at(first), row);
    rows_.push_back(row);
  }

  const mesh::Mesh& mesh_;
  std::vector<RowCell> cells_;
  const OppositeSides of_quad4_ = opposite_sides(CellType::quad4);
  const OppositeSides of_hexa8_ = opposite_sides(CellType::hexa8);
  mesh::CornerSets sets_;
  std::vector<std::array<Side, 2>> cells_at_; ///< by number in `sets_`
  std::vector<std::int32_t> row_of_;
  std::vector<Row> rows_;
};

} // namespace

std::vector<Layers> layers_of(const mesh::Mesh& mesh, const domain::Bulk& bulk) {
  const Rows rows(mesh, bulk);
  std::vector<Layers> layers;
  layers.reserve(bulk.cells.size());
  for (std::size_t cell = 0; cell < bulk.cells.size(); ++cell)
    layers.push_back(rows.layers_of(cell));
  return layers;
}

} // namespace rubato::model
