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

/// The cells around each numbered node, in compressed rows, and which of the nodes of such a cell it is.
struct CellsOfNodes {
  std::vector<std::int64_t> start;
  std::vector<CellIndex> cells;
  std::vector<std::int32_t> own;
};

CellsOfNodes cells_around_nodes(const mesh::Mesh& mesh, std::span<const CellIndex> cells,
                                const DofMap& dofs) {
  const auto number = [&](NodeIndex node) { return at(dofs.first_dof[at(node)] / dofs.components); };
  CellsOfNodes around{std::vector<std::int64_t>(dofs.nodes.size() + 1, 0), {}, {}};
  for (const auto cell : cells)
    for (const auto node : mesh.nodes_of(cell))
      ++around.start[number(node) + 1];
  std::partial_sum(around.start.begin(), around.start.end(), around.start.begin());
  around.cells.resize(at(around.start.back()));
  around.own.resize(around.cells.size());
  auto next = around.start;
  for (const auto cell : cells)
    for (std::int32_t own = 0; const auto node : mesh.nodes_of(cell)) {
      const auto place = at(next[number(node)]++);
      around.cells[place] = cell;
      around.own[place] = own++;
    }
  return around;
}

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

std::vector<std::int32_t> joined(std::vector<std::vector<std::int32_t>>&& parts) {
  auto whole = std::move(parts.front());
  std::size_t size = whole.size();
  for (std::size_t part = 1; part < parts.size(); ++part)
    size += parts[part].size();
  whole.reserve(size);
  for (std::size_t part = 1; part < parts.size(); ++part)
    whole.insert(whole.end(), parts[part].begin(), parts[part].end());
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
      first_dof_(dofs.first_dof), start_(dofs.nodes.size() + 1, 0), first_place_(first_places(mesh, cells)),
      places_(first_place_.back()) {
  const NodesInParts parts(dofs.nodes.size(), threads);
  const auto around = cells_around_nodes(mesh, cells, dofs);
  std::vector<std::vector<std::int32_t>> found(at(parts.count()));
  threads.each(parts.count(), [&](int part) {
    auto& neighbours = found[at(part)];
    std::vector<std::int32_t> last_seen_by(dofs.nodes.size(), -1);
    std::vector<std::int32_t> place_of(dofs.nodes.size());
    for (auto node = parts.first(part); node < parts.first(part + 1); ++node) {
      const auto first = neighbours.size();
      const auto each_cell = [&](const auto& work) {
        for (auto c = at(around.start[at(node)]); c < at(around.start[at(node) + 1]); ++c)
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
        place_of[at(neighbour)] = components_ * place++;
      each_cell([&](CellIndex cell, std::int32_t i) { put_places(cell, i, mesh, place_of); });
    }
  });
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  if (start_.back() * components_ * components_ > std::numeric_limits<int>::max())
    throw std::length_error("the matrix of this mesh has more entries than a 32-bit index can count");
  neighbours_ = joined(std::move(found));
}

void BlockPattern::put_places(CellIndex cell, std::int32_t own, const mesh::Mesh& mesh,
                              std::span<const std::int32_t> place_of) {
  const auto nodes = mesh.nodes_of(cell);
  const auto first = first_place_[at(cell)] + own * static_cast<std::int64_t>(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    places_[first + static_cast<Eigen::Index>(i)] = place_of[at(number_of(nodes[i]))];
}

SparseMatrix BlockPattern::zero_matrix() const {
  auto matrix = matrix_without_values();
  matrix.coeffs().setZero();
  return matrix;
}

SparseMatrix BlockPattern::matrix_without_values() const {
  const auto nodes = start_.size() - 1;
  const auto size = static_cast<Eigen::Index>(nodes) * components_;
  const auto area = components_ * components_;
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(start_.back() * area));
  const NodesInParts parts(nodes, shares_.threads());
  shares_.threads().each(parts.count(), [&](int part) {
    for (auto node = parts.first(part); node < parts.first(part + 1); ++node) {
      const auto neighbours =
          std::span(neighbours_).subspan(at(start_[at(node)]), at(start_[at(node) + 1] - start_[at(node)]));
      auto entry = static_cast<int>(start_[at(node)] * area);
      int* inner = matrix.innerIndexPtr() + entry;
      const int* const first = inner;
      for (const auto neighbour : neighbours)
        for (int a = 0; a < components_; ++a)
          *inner++ = neighbour * components_ + a;
      const auto rows = inner - first;
      for (int b = 1; b < components_; ++b)
        inner = std::copy_n(first, rows, inner);
      for (int b = 0; b < components_; ++b, entry += static_cast<int>(rows))
        matrix.outerIndexPtr()[node * components_ + b] = entry;
    }
  });
  matrix.outerIndexPtr()[size] = static_cast<int>(start_.back() * area);
  return matrix;
}

std::int32_t BlockPattern::number_of(NodeIndex node) const {
  return first_dof_[at(node)] / components_;
}

} // namespace rubato::domain
