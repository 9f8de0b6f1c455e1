// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/block_pattern.hpp"

#include "rubato/core/index.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace rubato::domain {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

/// Numbered nodes in parts that follow one another, one a thread.
class NodesInParts {
public:
  NodesInParts(std::size_t nodes, const Threads& threads)
      : nodes_(static_cast<std::int64_t>(nodes)), count_(threads.parts_of(nodes, 1000)) {}
  int count() const { return count_; }
  std::int32_t first(int part) const { return static_cast<std::int32_t>(nodes_ * part / count_); }

private:
  std::int64_t nodes_;
  int count_;
};

/// Of mesh nodes that have dofs.
std::vector<std::int32_t> node_numbers(const DofMap& dofs) {
  std::vector<std::int32_t> numbers(dofs.first_dof.size());
  std::ranges::transform(dofs.first_dof, numbers.begin(), [&](int dof) { return dof / dofs.components; });
  return numbers;
}

/// The cells around each numbered node, in compressed rows, and which of the nodes of such a cell it is.
struct CellsOfNodes {
  std::vector<std::int64_t> start;
  Eigen::ArrayX<CellIndex> cells;
  Eigen::ArrayX<std::int32_t> own;
};

/// Each thread sees all cells, and notes those around its nodes.
CellsOfNodes cells_around_nodes(const mesh::Mesh& mesh, std::span<const CellIndex> cells,
                                std::span<const std::int32_t> number_of, std::size_t nodes,
                                const Threads& threads) {
  const NodesInParts parts(nodes, threads);
  const auto each_of_part = [&](int part, const auto& work) {
    const auto first = parts.first(part), end = parts.first(part + 1);
    for (const auto cell : cells)
      for (std::int32_t own = 0; const auto node : mesh.nodes_of(cell)) {
        if (const auto number = number_of[at(node)]; number >= first && number < end)
          work(at(number), cell, own);
        ++own;
      }
  };
  CellsOfNodes around{std::vector<std::int64_t>(nodes + 1, 0), {}, {}};
  threads.each(parts.count(), [&](int part) {
    each_of_part(part, [&](std::size_t node, CellIndex, std::int32_t) { ++around.start[node + 1]; });
  });
  std::partial_sum(around.start.begin(), around.start.end(), around.start.begin());
  around.cells.resize(around.start.back());
  around.own.resize(around.start.back());
  threads.each(parts.count(), [&](int part) {
    std::vector<std::int64_t> next(around.start.begin() + parts.first(part),
                                   around.start.begin() + parts.first(part + 1));
    each_of_part(part, [&](std::size_t node, CellIndex cell, std::int32_t own) {
      const auto place = next[node - at(parts.first(part))]++;
      around.cells[place] = cell;
      around.own[place] = own;
    });
  });
  return around;
}

Eigen::ArrayX<std::int32_t> joined(const std::vector<std::vector<std::int32_t>>& parts,
                                   const Threads& threads) {
  std::vector<std::size_t> starts{0};
  for (const auto& part : parts)
    starts.push_back(starts.back() + part.size());
  Eigen::ArrayX<std::int32_t> whole(static_cast<Eigen::Index>(starts.back()));
  threads.each(static_cast<int>(parts.size()),
               [&](int part) { std::ranges::copy(parts[at(part)], whole.data() + starts[at(part)]); });
  return whole;
}

/// Where the square of places of each cell of the mesh begins, nodes × nodes of those in `cells`.
std::vector<std::int64_t> first_places(const mesh::Mesh& mesh, std::span<const CellIndex> cells) {
  std::vector<std::int64_t> first(at(mesh.cell_count()) + 1, 0);
  for (const auto cell : cells) {
    const auto nodes = static_cast<std::int64_t>(mesh.nodes_of(cell).size());
    first[at(cell) + 1] = nodes * nodes;
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

} // namespace

BlockPattern::BlockPattern(const mesh::Mesh& mesh, std::span<const CellIndex> cells, const DofMap& dofs,
                           const Threads& threads)
    : components_(dofs.components), cells_(cells.begin(), cells.end()), shares_(mesh, cells, threads),
      first_dof_(dofs.first_dof), number_(node_numbers(dofs)), start_(dofs.nodes.size() + 1, 0),
      first_place_(first_places(mesh, cells)), places_(first_place_.back()) {
  const NodesInParts parts(dofs.nodes.size(), threads);
  const auto around = cells_around_nodes(mesh, cells, number_, dofs.nodes.size(), threads);
  std::vector<std::vector<std::int32_t>> found(at(parts.count()));
  threads.each(parts.count(), [&](int part) {
    auto& neighbours = found[at(part)];
    std::vector<std::int32_t> last_seen_by(dofs.nodes.size(), -1);
    std::vector<std::int32_t> place_of(dofs.nodes.size());
    for (auto node = parts.first(part); node < parts.first(part + 1); ++node) {
      const auto first = neighbours.size();
      const auto each_cell = [&](const auto& work) {
        for (auto c = around.start[at(node)]; c < around.start[at(node) + 1]; ++c)
          work(around.cells[c], around.own[c]);
      };
      each_cell([&](CellIndex cell, std::int32_t) {
        for (const auto other : mesh.nodes_of(cell)) {
          const auto neighbour = number_of(other);
          if (std::exchange(last_seen_by[at(neighbour)], node) != node)
            neighbours.push_back(neighbour);
        }
      });
      const auto own = std::span(neighbours).subspan(first);
      start_[at(node) + 1] = static_cast<std::int64_t>(own.size());
      std::ranges::sort(own);
      for (std::int32_t place = 0; const auto neighbour : own)
        place_of[at(neighbour)] = place++;
      each_cell([&](CellIndex cell, std::int32_t i) { put_places(cell, i, mesh, place_of); });
    }
  });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  if (start_.back() * components_ * components_ > std::numeric_limits<int>::max())
    throw std::length_error("the matrix of this mesh has more entries than a 32-bit index can count");
  neighbours_ = joined(found, threads);
}

void BlockPattern::put_places(CellIndex cell, std::int32_t own, const mesh::Mesh& mesh,
                              std::span<const std::int32_t> place_of) {
  const auto nodes = mesh.nodes_of(cell);
  const auto first = first_place_[at(cell)] + own * static_cast<std::int64_t>(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    places_[first + static_cast<Eigen::Index>(i)] = place_of[at(number_of(nodes[i]))];
}

SparseMatrix BlockPattern::zero_matrix() const {
  auto matrix = matrix_without_values(BlockEntries::all);
  matrix.coeffs().setZero();
  return matrix;
}

/// Of the columns of a node, column by column.
void BlockPattern::put_rows(std::span<const std::int32_t> neighbours, BlockEntries entries, int* rows) const {
  if (entries == BlockEntries::diagonal) {
    for (int b = 0; b < components_; ++b)
      rows = std::ranges::transform(neighbours, rows, [&](int neighbour) {
               return neighbour * components_ + b;
             }).out;
    return;
  }
  const int* const first = rows;
  for (const auto neighbour : neighbours)
    for (int a = 0; a < components_; ++a)
      *rows++ = neighbour * components_ + a;
  const auto of_column = rows - first;
  for (int b = 1; b < components_; ++b)
    rows = std::copy_n(first, of_column, rows);
}

SparseMatrix BlockPattern::matrix_without_values(BlockEntries entries) const {
  const auto nodes = start_.size() - 1;
  const auto size = static_cast<Eigen::Index>(nodes) * components_;
  const auto of_column = entries == BlockEntries::all ? components_ : 1; // of a block
  const auto of_block = of_column * components_;
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(start_.back() * of_block));
  const NodesInParts parts(nodes, shares_.threads());
  shares_.threads().each(parts.count(), [&](int part) {
    for (auto node = parts.first(part); node < parts.first(part + 1); ++node) {
      const auto count = static_cast<int>(start_[at(node) + 1] - start_[at(node)]);
      auto entry = static_cast<int>(start_[at(node)] * of_block);
      put_rows({neighbours_.data() + start_[at(node)], at(count)}, entries, matrix.innerIndexPtr() + entry);
      for (int b = 0; b < components_; ++b, entry += count * of_column)
        matrix.outerIndexPtr()[node * components_ + b] = entry;
    }
  });
  matrix.outerIndexPtr()[size] = static_cast<int>(start_.back() * of_block);
  return matrix;
}

} // namespace rubato::domain
