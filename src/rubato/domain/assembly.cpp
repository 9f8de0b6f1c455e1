// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/assembly.hpp"

#include "rubato/core/error.hpp"
#include "rubato/domain/cell_matrices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace rubato::domain {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// The cells around each numbered node, in compressed rows.
struct CellsOfNodes {
  std::vector<std::int64_t> start;
  std::vector<CellIndex> cells;
};

CellsOfNodes cells_around_nodes(const mesh::Mesh& mesh, std::span<const CellIndex> cells,
                                const DofMap& dofs) {
  const auto number = [&](NodeIndex node) { return at(dofs.first_dof[at(node)] / dofs.components); };
  CellsOfNodes around{std::vector<std::int64_t>(dofs.nodes.size() + 1, 0), {}};
  for (const auto cell : cells)
    for (const auto node : mesh.nodes_of(cell))
      ++around.start[number(node) + 1];
  std::partial_sum(around.start.begin(), around.start.end(), around.start.begin());
  around.cells.resize(at(around.start.back()));
  auto next = around.start;
  for (const auto cell : cells)
    for (const auto node : mesh.nodes_of(cell))
      around.cells[at(next[number(node)]++)] = cell;
  return around;
}

/// Visits what a cell of those numbered nodes adds to: block row, block column, column in the block, its
/// first value in the matrix. `place_in_column(row, column)`: where the block row begins in a column of the
/// other.
template <class Place, class Visit>
void visit_block_columns(std::span<const std::int32_t> numbers, int components, SparseMatrix& matrix,
                         const Place& place_in_column, const Visit& visit) {
  for (std::size_t j = 0; j < numbers.size(); ++j) {
    const int* outer = matrix.outerIndexPtr() + std::int64_t{numbers[j]} * components;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto place = place_in_column(numbers[i], numbers[j]);
      for (int b = 0; b < components; ++b)
        visit(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j), b,
              matrix.valuePtr() + outer[b] + place);
    }
  }
}

/// Of the nodes of one cell, without a heap.
struct Numbers {
  template <class Number>
  Numbers(std::span<const NodeIndex> nodes, const Number& number_of) : count(nodes.size()) {
    std::ranges::transform(nodes, values.begin(), number_of);
  }
  operator std::span<const std::int32_t>() const { return {values.data(), count}; }

  std::array<std::int32_t, 27> values;
  std::size_t count;
};

/// One cell of the bulk with all that its matrices are made of.
struct Cell {
  Cell(const mesh::Mesh& mesh, const Bulk& bulk, std::span<const double> factors, std::size_t i)
      : index(bulk.cells[i]), type(mesh.type_of(index)), nodes(mesh.nodes_of(index)), points(mesh, nodes),
        law(bulk.law(i)), factor(factors.empty() ? 1. : factors[at(bulk.law_of_cell[i])]) {}

  Eigen::Index node_count() const { return static_cast<Eigen::Index>(nodes.size()); }

  CellIndex index;
  CellType type;
  std::span<const NodeIndex> nodes;
  CellPoints points;
  const material::Law& law;
  double factor; ///< of its law
};

/// The reason is a material or a size beyond what numbers hold: it is told where it comes from.
template <class Values>
void require_finite(const Values& element, const Cell& cell, const mesh::Mesh& mesh, std::string_view what) {
  if (element.allFinite())
    return;
  throw InputError(fmt::format("{}: its {} is not finite ({})", cell_label(mesh, cell.index), what,
                               material::described(cell.law)));
}

} // namespace

BlockPattern::BlockPattern(const mesh::Mesh& mesh, std::span<const CellIndex> cells, const DofMap& dofs)
    : components_(dofs.components), first_dof_(dofs.first_dof), start_(dofs.nodes.size() + 1, 0) {
  const auto around = cells_around_nodes(mesh, cells, dofs);
  std::vector<std::int32_t> last_seen_by(dofs.nodes.size(), -1);
  for (std::int32_t node = 0; at(node) < dofs.nodes.size(); ++node) {
    for (auto c = around.start[at(node)]; c < around.start[at(node) + 1]; ++c)
      for (const auto other : mesh.nodes_of(around.cells[at(c)])) {
        const auto neighbour = number_of(other);
        if (last_seen_by[at(neighbour)] != node)
          neighbours_.push_back(neighbour);
        last_seen_by[at(neighbour)] = node;
      }
    start_[at(node) + 1] = static_cast<std::int64_t>(neighbours_.size());
    std::sort(neighbours_.begin() + start_[at(node)], neighbours_.end());
  }
  if (start_.back() * components_ * components_ > std::numeric_limits<int>::max())
    throw std::length_error("the matrix of this mesh has more entries than a 32-bit index can count");
}

SparseMatrix BlockPattern::zero_matrix() const {
  const auto nodes = static_cast<std::int64_t>(start_.size()) - 1;
  const auto size = static_cast<Eigen::Index>(nodes * components_);
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(start_.back() * components_ * components_));
  int* outer = matrix.outerIndexPtr();
  int* inner = matrix.innerIndexPtr();
  *outer++ = 0;
  for (std::int64_t node = 0; node < nodes; ++node)
    for (int b = 0; b < components_; ++b) {
      for (auto k = start_[at(node)]; k < start_[at(node) + 1]; ++k)
        for (int a = 0; a < components_; ++a)
          *inner++ = neighbours_[at(k)] * components_ + a;
      *outer++ = static_cast<int>(inner - matrix.innerIndexPtr());
    }
  matrix.coeffs().setZero();
  return matrix;
}

std::int32_t BlockPattern::number_of(NodeIndex node) const {
  return first_dof_[at(node)] / components_;
}

std::int64_t BlockPattern::place_in_column(std::int32_t row_node, std::int32_t column_node) const {
  const auto begin = neighbours_.begin() + start_[at(column_node)];
  const auto end = neighbours_.begin() + start_[at(column_node) + 1];
  return (std::lower_bound(begin, end, row_node) - begin) * components_;
}

void BlockPattern::add(std::span<const NodeIndex> nodes, const Eigen::MatrixXd& element,
                       SparseMatrix& matrix) const {
  const Numbers numbers(nodes, [&](NodeIndex node) { return number_of(node); });
  visit_block_columns(
      numbers, components_, matrix, [&](int row, int column) { return place_in_column(row, column); },
      [&](Eigen::Index i, Eigen::Index j, int b, double* values) {
        const double* source = element.col(j * components_ + b).data() + i * components_;
        for (int a = 0; a < components_; ++a)
          values[a] += source[a];
      });
}

void BlockPattern::add_to_diagonals(std::span<const NodeIndex> nodes, const Eigen::MatrixXd& m,
                                    SparseMatrix& matrix) const {
  const Numbers numbers(nodes, [&](NodeIndex node) { return number_of(node); });
  visit_block_columns(
      numbers, components_, matrix, [&](int row, int column) { return place_in_column(row, column); },
      [&](Eigen::Index i, Eigen::Index j, int b, double* values) { values[b] += m(i, j); });
}

namespace {

/// Of the cells that `is_wanted` says, by their places in the bulk.
template <class Wanted>
SparseMatrix assemble_stiffness_of(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                                   std::span<const double> factors, const Wanted& is_wanted) {
  auto matrix = pattern.zero_matrix();
  Eigen::MatrixXd element;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    if (!is_wanted(i))
      continue;
    const Cell cell(mesh, bulk, factors, i);
    const auto size = cell.node_count() * element::component_count(bulk.section.physics);
    element.resize(size, size);
    cell_stiffness(bulk, i, cell.type, cell.points, element);
    if (!factors.empty())
      element *= cell.factor;
    require_finite(element, cell, mesh, "stiffness");
    pattern.add(cell.nodes, element, matrix);
  }
  return matrix;
}

} // namespace

SparseMatrix assemble_stiffness(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                                std::span<const double> factors) {
  return assemble_stiffness_of(mesh, bulk, pattern, factors, [](std::size_t) { return true; });
}

SparseMatrix assemble_constant_stiffness(const mesh::Mesh& mesh, const Bulk& bulk,
                                         const BlockPattern& pattern) {
  return assemble_stiffness_of(mesh, bulk, pattern, {}, [&](std::size_t i) { return bulk.is_constant(i); });
}

SparseMatrix assemble_mass(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                           std::span<const double> factors) {
  auto matrix = pattern.zero_matrix();
  Eigen::MatrixXd element;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const Cell cell(mesh, bulk, factors, i);
    element.resize(cell.node_count(), cell.node_count());
    cell_mass(bulk, i, cell.type, cell.points, element);
    element *= cell.factor;
    require_finite(element, cell, mesh, "mass");
    pattern.add_to_diagonals(cell.nodes, element, matrix);
  }
  return matrix;
}

Eigen::VectorXd lumped_mass(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                            std::span<const double> factors) {
  Eigen::VectorXd total = Eigen::VectorXd::Zero(dofs.dof_count);
  Eigen::VectorXd element;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const Cell cell(mesh, bulk, factors, i);
    element.resize(cell.node_count());
    cell_lumped_mass(bulk, i, cell.type, cell.points, element);
    element *= cell.factor;
    require_finite(element, cell, mesh, "mass");
    for (std::size_t n = 0; n < cell.nodes.size(); ++n)
      total.segment(dofs.first_dof[at(cell.nodes[n])], dofs.components).array() +=
          element[static_cast<Eigen::Index>(n)];
  }
  return total;
}

} // namespace rubato::domain
