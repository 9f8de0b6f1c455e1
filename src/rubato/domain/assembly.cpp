// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/assembly.hpp"

#include "rubato/core/error.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/element/hexa8_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>

namespace rubato::domain {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

std::size_t at(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

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

/// The C columns of a node in a matrix.
template <int C> using NodeColumns = std::array<double*, static_cast<std::size_t>(C)>;

template <int C> NodeColumns<C> columns_of_node(SparseMatrix& matrix, int first) {
  NodeColumns<C> columns;
  for (std::size_t b = 0; b < C; ++b)
    columns[b] = matrix.valuePtr() + matrix.outerIndexPtr()[static_cast<std::size_t>(first) + b];
  return columns;
}

template <int C> void add_column(const double* from, double* into) {
  Eigen::Map<Eigen::Array2d>{into} += Eigen::Map<const Eigen::Array2d>{from};
  if constexpr (C == 3)
    into[2] += from[2];
}

/// Adds blocks of C × C numbers, their columns `stride` apart, to those that begin at places in the columns
/// of a node.
template <int C>
void add_blocks(const double* blocks, Eigen::Index stride, std::span<const std::int32_t> places,
                const NodeColumns<C>& columns) {
  for (const auto place : places) {
    add_column<C>(blocks, columns[0] + place);
    add_column<C>(blocks + stride, columns[1] + place);
    if constexpr (C == 3)
      add_column<C>(blocks + 2 * stride, columns[2] + place);
    blocks += C;
  }
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

/// Of matrices the diagonal: no entry of a semidefinite one is larger than both of its row and column there.
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
    : components_(dofs.components), first_dof_(dofs.first_dof), start_(dofs.nodes.size() + 1, 0),
      first_place_(first_places(mesh, cells)), places_(at(first_place_.back())) {
  const auto around = cells_around_nodes(mesh, cells, dofs);
  std::vector<std::int32_t> last_seen_by(dofs.nodes.size(), -1);
  std::vector<std::int32_t> place_of(dofs.nodes.size());
  for (std::int32_t node = 0; at(node) < dofs.nodes.size(); ++node) {
    const auto each_cell = [&](const auto& work) {
      for (auto c = at(around.start[at(node)]); c < at(around.start[at(node) + 1]); ++c)
        work(around.cells[c], around.own[c]);
    };
    each_cell([&](CellIndex cell, std::int32_t) {
      for (const auto other : mesh.nodes_of(cell)) {
        const auto neighbour = number_of(other);
        if (std::exchange(last_seen_by[at(neighbour)], node) != node)
          neighbours_.push_back(neighbour);
      }
    });
    start_[at(node) + 1] = static_cast<std::int64_t>(neighbours_.size());
    const auto neighbours = std::span(neighbours_).subspan(at(start_[at(node)]));
    std::ranges::sort(neighbours);
    for (std::int32_t place = 0; const auto neighbour : neighbours)
      place_of[at(neighbour)] = components_ * place++;
    each_cell([&](CellIndex cell, std::int32_t own) { put_places(cell, own, mesh, place_of); });
  }
  if (start_.back() * components_ * components_ > std::numeric_limits<int>::max())
    throw std::length_error("the matrix of this mesh has more entries than a 32-bit index can count");
}

void BlockPattern::put_places(CellIndex cell, std::int32_t own, const mesh::Mesh& mesh,
                              std::span<const std::int32_t> place_of) {
  const auto nodes = mesh.nodes_of(cell);
  const auto first = first_place_[at(cell)] + own * static_cast<std::int64_t>(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    places_[at(first) + i] = place_of[at(number_of(nodes[i]))];
}

SparseMatrix BlockPattern::zero_matrix() const {
  auto matrix = matrix_without_values();
  matrix.coeffs().setZero();
  return matrix;
}

SparseMatrix BlockPattern::matrix_without_values() const {
  const auto nodes = static_cast<std::int64_t>(start_.size()) - 1;
  const auto size = static_cast<Eigen::Index>(nodes * components_);
  SparseMatrix matrix(size, size);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(start_.back() * components_ * components_));
  int* outer = matrix.outerIndexPtr();
  int* inner = matrix.innerIndexPtr();
  *outer++ = 0;
  for (std::int64_t node = 0; node < nodes; ++node) {
    const int* const first = inner;
    for (auto k = start_[at(node)]; k < start_[at(node) + 1]; ++k)
      for (int a = 0; a < components_; ++a)
        *inner++ = neighbours_[at(k)] * components_ + a;
    const auto rows = inner - first;
    for (int b = 1; b < components_; ++b)
      inner = std::copy_n(first, rows, inner);
    for (int b = 1; b <= components_; ++b, ++outer)
      *outer = outer[-1] + static_cast<int>(rows);
  }
  return matrix;
}

int BlockPattern::columns_up_to(std::span<const NodeIndex> nodes) const {
  int last = 0;
  for (const auto node : nodes)
    last = std::max(last, first_dof_[at(node)]);
  return last + components_;
}

std::int32_t BlockPattern::number_of(NodeIndex node) const {
  return first_dof_[at(node)] / components_;
}

template <class Visit>
void BlockPattern::visit_columns(CellIndex cell, std::span<const NodeIndex> nodes, SparseMatrix& matrix,
                                 const Visit& visit) const {
  const auto places = std::span(places_).subspan(at(first_place_[at(cell)]), nodes.size() * nodes.size());
  for (std::size_t j = 0; j < nodes.size(); ++j) {
    const int* outer = matrix.outerIndexPtr() + first_dof_[at(nodes[j])];
    for (int b = 0; b < components_; ++b)
      visit(static_cast<Eigen::Index>(j), b, places.subspan(j * nodes.size(), nodes.size()),
            matrix.valuePtr() + outer[b]);
  }
}

void BlockPattern::add(CellIndex cell, std::span<const NodeIndex> nodes, const Eigen::MatrixXd& element,
                       SparseMatrix& matrix) const {
  const auto places = std::span(places_).subspan(at(first_place_[at(cell)]), nodes.size() * nodes.size());
  const auto add = [&]<int C>(std::integral_constant<int, C>) {
    for (std::size_t j = 0; j < nodes.size(); ++j)
      add_blocks<C>(element.col(static_cast<Eigen::Index>(C * j)).data(), element.outerStride(),
                    places.subspan(j * nodes.size(), nodes.size()),
                    columns_of_node<C>(matrix, first_dof_[at(nodes[j])]));
  };
  if (components_ == 3)
    add(std::integral_constant<int, 3>{});
  else
    add(std::integral_constant<int, 2>{});
}

void BlockPattern::add_to_diagonals(CellIndex cell, std::span<const NodeIndex> nodes,
                                    const Eigen::MatrixXd& m, SparseMatrix& matrix) const {
  visit_columns(cell, nodes, matrix, [&](Eigen::Index j, int b, auto places, double* column) {
    const double* value = m.col(j).data();
    for (const auto place : places)
      column[place + b] += *value++;
  });
}

namespace {

/// A matrix whose columns become zero when cells reach them: then they are near when the cells add to them,
/// which is sooner done than to fetch zeros of the whole matrix from afar.
class Sum {
public:
  explicit Sum(const BlockPattern& pattern) : pattern_(pattern), matrix_(pattern.matrix_without_values()) {}

  /// To be added to at the columns of those nodes.
  SparseMatrix& at(std::span<const NodeIndex> nodes) {
    clear(pattern_.columns_up_to(nodes));
    return matrix_;
  }
  SparseMatrix take() {
    clear(static_cast<int>(matrix_.cols()));
    SparseMatrix whole;
    whole.swap(matrix_); // Eigen copies where others move
    return whole;
  }

private:
  void clear(int end) {
    if (end <= cleared_)
      return;
    const int* outer = matrix_.outerIndexPtr();
    std::fill(matrix_.valuePtr() + outer[cleared_], matrix_.valuePtr() + outer[end], 0.0);
    cleared_ = end;
  }

  const BlockPattern& pattern_;
  SparseMatrix matrix_;
  int cleared_ = 0; ///< columns
};

/// That of one linear cell depends on its edges alone: laws are the same everywhere, no radius counts.
bool has_stiffness_of_edges(const Bulk& bulk, std::size_t cell) {
  return bulk.section.physics != study::Physics::axisymmetric && bulk.field(cell) == nullptr &&
         bulk.behaviour(cell) == nullptr;
}

/// The nodes of a cell seen from its first one.
class Edges {
public:
  Edges() = default;
  explicit Edges(std::span<const Eigen::Vector3d> points) : count_(points.size()) {
    for (std::size_t n = 0; n < count_; ++n)
      from_first_[n] = points[n] - points[0];
  }
  Edges(const Edges& other) : count_(other.count_) { copy(other); }
  Edges& operator=(const Edges& other) {
    count_ = other.count_;
    copy(other);
    return *this;
  }
  std::span<const Eigen::Vector3d> points() const { return {from_first_.data(), count_}; }
  bool operator==(const Edges& other) const { return std::ranges::equal(points(), other.points()); }

private:
  void copy(const Edges& other) { std::ranges::copy(other.points(), from_first_.begin()); }

  std::array<Eigen::Vector3d, 27> from_first_; ///< the first `count_`
  std::size_t count_ = 0;
};

/// What the stiffness of a linear cell depends on.
struct LinearShape {
  std::int32_t law = -1; ///< −1: of no cell
  CellType type = CellType::point1;
  Edges edges;
  bool operator==(const LinearShape&) const = default;
};

/// Stiffnesses of cells one after the other. Where edges are all that counts, the nodes are seen from the
/// first one: cells of one law with the same edges have the same stiffness then, to the last digit, and those
/// that follow each other, as in generated boxes, have it computed once. That of another HEXA8 is computed
/// together with that of the cell after it, which takes no longer.
class Stiffnesses {
public:
  Stiffnesses(const mesh::Mesh& mesh, const Bulk& bulk) : mesh_(mesh), bulk_(bulk) {}

  /// `i`: the place of the cell in the bulk. Times the factor of its law.
  const Eigen::MatrixXd& of(std::size_t i, const Cell& cell) {
    if (i == place_ahead_) {
      shape_ = shape_ahead_;
      element_.swap(element_ahead_);
    } else if (!has_stiffness_of_edges(bulk_, i)) {
      shape_ = {};
      compute(i, cell, cell.points);
    } else {
      const LinearShape shape{bulk_.law_of_cell[i], cell.type, Edges(cell.points)};
      if (shape == shape_)
        return element_;
      shape_ = shape;
      if (!compute_with_next(i, cell))
        compute(i, cell, shape_.edges.points());
    }
    if (cell.factor != 1)
      element_ *= cell.factor;
    require_finite(element_.diagonal(), cell, mesh_, "stiffness");
    return element_;
  }

private:
  void compute(std::size_t i, const Cell& cell, std::span<const Eigen::Vector3d> points) {
    const auto size = cell.node_count() * element::component_count(bulk_.section.physics);
    element_.resize(size, size);
    cell_stiffness(bulk_, i, cell.type, points, element_);
  }

  std::optional<material::Lame> hexa8_lame(const Cell& cell) const {
    if (cell.type != CellType::hexa8)
      return {};
    return material::isotropic(cell.law, bulk_.section.physics);
  }

  /// Of `shape_`. False where the next cell has no stiffness that this can be computed with, or the same one.
  bool compute_with_next(std::size_t i, const Cell& cell) {
    const auto next = i + 1;
    if (next == bulk_.cells.size() || !has_stiffness_of_edges(bulk_, next))
      return false;
    const Cell other(mesh_, bulk_, {}, next);
    const auto lame = hexa8_lame(cell), lame_ahead = hexa8_lame(other);
    if (!lame || !lame_ahead)
      return false;
    shape_ahead_ = {bulk_.law_of_cell[next], other.type, Edges(other.points)};
    if (shape_ahead_ == shape_)
      return false;
    element::set_hexa8_stiffness(
        {element::Hexa8Stiffness{shape_.edges.points(), *lame, element_},
         element::Hexa8Stiffness{shape_ahead_.edges.points(), *lame_ahead, element_ahead_}});
    place_ahead_ = next;
    return true;
  }

  const mesh::Mesh& mesh_;
  const Bulk& bulk_;
  Eigen::MatrixXd element_;
  LinearShape shape_; ///< that `element_` is of
  std::size_t place_ahead_ = std::numeric_limits<std::size_t>::max();
  Eigen::MatrixXd element_ahead_; ///< of the cell there, without the factor
  LinearShape shape_ahead_;
};

/// Of the cells that `is_wanted` says, by their places in the bulk.
template <class Wanted>
SparseMatrix assemble_stiffness_of(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                                   std::span<const double> factors, const Wanted& is_wanted) {
  Sum sum(pattern);
  Stiffnesses stiffnesses(mesh, bulk);
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    if (!is_wanted(i))
      continue;
    const Cell cell(mesh, bulk, factors, i);
    pattern.add(cell.index, cell.nodes, stiffnesses.of(i, cell), sum.at(cell.nodes));
  }
  return sum.take();
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
  Sum sum(pattern);
  Eigen::MatrixXd element;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const Cell cell(mesh, bulk, factors, i);
    element.resize(cell.node_count(), cell.node_count());
    cell_mass(bulk, i, cell.type, cell.points, element);
    element *= cell.factor;
    require_finite(element.diagonal(), cell, mesh, "mass");
    pattern.add_to_diagonals(cell.index, cell.nodes, element, sum.at(cell.nodes));
  }
  return sum.take();
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
