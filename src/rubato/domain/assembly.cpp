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

/// Adds blocks of C rows under each other to those that begin at places in a column.
template <int C> void add_blocks(const double* blocks, std::span<const std::int32_t> places, double* column) {
  for (const auto place : places) {
    std::array<double, C> sum;
    for (std::size_t a = 0; a < C; ++a)
      sum[a] = column[place + static_cast<std::int32_t>(a)] + blocks[a];
    std::ranges::copy(sum, column + place);
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

BlockPattern::BlockPattern(const mesh::Mesh& mesh, std::span<const CellIndex> cells, const DofMap& dofs,
                           const Threads& threads)
    : components_(dofs.components), cells_(cells.begin(), cells.end()), shares_(mesh, cells, threads),
      first_dof_(dofs.first_dof), start_(dofs.nodes.size() + 1, 0), first_place_(first_places(mesh, cells)),
      places_(at(first_place_.back())) {
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
    places_[at(first) + i] = place_of[at(number_of(nodes[i]))];
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
      int entry = static_cast<int>(start_[at(node)] * area);
      for (int b = 0; b < components_; ++b) {
        matrix.outerIndexPtr()[node * components_ + b] = entry;
        for (const auto neighbour : neighbours)
          for (int a = 0; a < components_; ++a)
            matrix.innerIndexPtr()[entry++] = neighbour * components_ + a;
      }
    }
  });
  matrix.outerIndexPtr()[size] = static_cast<int>(start_.back() * area);
  return matrix;
}

std::int32_t BlockPattern::number_of(NodeIndex node) const {
  return first_dof_[at(node)] / components_;
}

namespace {

enum class Entries {
  blocks,   ///< of matrices of nodes · components
  diagonals ///< of m ⊗ 1, m a matrix of nodes
};

/// A matrix of the whole that cells add to. Columns become zero when a cell first reaches them: then they are
/// near when cells add to them, which is sooner done than to fetch zeros of the whole matrix from afar.
class Sum {
public:
  explicit Sum(const BlockPattern& pattern)
      : pattern_(pattern), matrix_(pattern.matrix_without_values()),
        is_clear_(at(matrix_.cols() / pattern.components()), 0) {}

  /// Adds those columns of an element matrix, node-major, whose nodes take part.
  template <Entries E, class TakesPart>
  void add(CellIndex cell, std::span<const NodeIndex> nodes, const Eigen::MatrixXd& element,
           const TakesPart& takes_part) {
    const auto places = pattern_.places(cell, nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (takes_part(nodes[j]))
        add_column<E>(pattern_.first_dof(nodes[j]), j, places.subspan(j * nodes.size(), nodes.size()),
                      element);
  }

  SparseMatrix take() {
    for (std::size_t node = 0; node < is_clear_.size(); ++node)
      clear(static_cast<int>(node) * pattern_.components());
    SparseMatrix whole;
    whole.swap(matrix_); // Eigen copies where others move
    return whole;
  }

private:
  void clear(int dof) {
    auto& is_clear = is_clear_[at(dof / pattern_.components())];
    if (std::exchange(is_clear, char{1}) != 0)
      return;
    const int* outer = matrix_.outerIndexPtr() + dof;
    std::fill(matrix_.valuePtr() + outer[0], matrix_.valuePtr() + outer[pattern_.components()], 0.0);
  }

  /// Those of node j of the element, which has that first dof.
  template <Entries E>
  void add_column(int dof, std::size_t j, std::span<const std::int32_t> places,
                  const Eigen::MatrixXd& element) {
    clear(dof);
    if constexpr (E == Entries::diagonals)
      add_diagonals(element.col(static_cast<Eigen::Index>(j)).data(), dof, places);
    else if (pattern_.components() == 3)
      add_all_blocks<3>(element, dof, j, places);
    else
      add_all_blocks<2>(element, dof, j, places);
  }

  template <int C>
  void add_all_blocks(const Eigen::MatrixXd& element, int dof, std::size_t j,
                      std::span<const std::int32_t> places) {
    const int* outer = matrix_.outerIndexPtr() + dof;
    for (int b = 0; b < C; ++b)
      add_blocks<C>(element.col(static_cast<Eigen::Index>(j) * C + b).data(), places,
                    matrix_.valuePtr() + outer[b]);
  }

  void add_diagonals(const double* values, int dof, std::span<const std::int32_t> places) {
    const int* outer = matrix_.outerIndexPtr() + dof;
    for (int b = 0; b < pattern_.components(); ++b)
      for (std::size_t i = 0; i < places.size(); ++i)
        matrix_.valuePtr()[outer[b] + places[i] + b] += values[i];
  }

  const BlockPattern& pattern_;
  SparseMatrix matrix_;
  std::vector<char> is_clear_; ///< of each numbered node, whether its columns are no longer what memory was
};

/// Of the cells of the pattern, their places in the bulk, whose order they have.
std::vector<std::size_t> places_in_bulk(const BlockPattern& pattern, const Bulk& bulk) {
  std::vector<std::size_t> places;
  const auto cells = pattern.cells();
  places.reserve(cells.size());
  for (std::size_t i = 0; i < bulk.cells.size() && places.size() < cells.size(); ++i)
    if (bulk.cells[i] == cells[places.size()])
      places.push_back(i);
  if (places.size() < cells.size())
    throw std::invalid_argument("a pattern has cells that the bulk has not, or in another order");
  return places;
}

/// The sum of what `matrix_of` gives for each cell of the pattern, called with the share and the place in the
/// bulk; null where a cell adds nothing.
template <Entries E, class MatrixOf>
SparseMatrix sum_of_cells(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                          const MatrixOf& matrix_of) {
  Sum sum(pattern);
  const auto& shares = pattern.shares();
  const auto places = places_in_bulk(pattern, bulk);
  std::vector<Eigen::MatrixXd> kept(shares.border().size());
  shares.each([&](int share, std::size_t i) {
    const Eigen::MatrixXd* element = matrix_of(share, places[i]);
    if (element == nullptr)
      return;
    const auto cell = pattern.cells()[i];
    const auto border = shares.place_in_border(i);
    if (border < 0)
      return sum.add<E>(cell, mesh.nodes_of(cell), *element, [](NodeIndex) { return true; });
    sum.add<E>(cell, mesh.nodes_of(cell), *element, [&](NodeIndex node) { return !shares.is_shared(node); });
    kept[at(border)] = *element;
  });
  for (std::size_t b = 0; b < kept.size(); ++b) {
    const auto cell = pattern.cells()[shares.border()[b]];
    if (kept[b].size() > 0)
      sum.add<E>(cell, mesh.nodes_of(cell), kept[b], [&](NodeIndex node) { return shares.is_shared(node); });
  }
  return sum.take();
}

/// That of one linear cell depends on its edges alone: laws are the same everywhere, no radius counts.
bool has_stiffness_of_edges(const Bulk& bulk, std::size_t cell) {
  return bulk.section.physics != study::Physics::axisymmetric && bulk.field(cell) == nullptr &&
         bulk.behaviour(cell) == nullptr;
}

/// Stiffnesses of cells one after the other. Where edges are all that counts, the nodes are seen from the
/// first one: cells of one law with the same edges have the same stiffness then, to the last digit, and those
/// that follow each other, as in generated boxes, have it computed once.
class Stiffnesses {
public:
  Stiffnesses(const mesh::Mesh& mesh, const Bulk& bulk) : mesh_(mesh), bulk_(bulk) {}

  /// `i`: the place of the cell in the bulk. Times the factor of its law.
  const Eigen::MatrixXd& of(std::size_t i, const Cell& cell) {
    const std::span<const Eigen::Vector3d> points = cell.points;
    if (!has_stiffness_of_edges(bulk_, i)) {
      last_law_ = -1;
      compute(i, cell, points);
      return element_;
    }
    std::array<Eigen::Vector3d, 27> from_first;
    for (std::size_t n = 0; n < points.size(); ++n)
      from_first[n] = points[n] - points[0];
    const auto edges = std::span<const Eigen::Vector3d>(from_first).first(points.size());
    if (last_law_ == bulk_.law_of_cell[i] && last_type_ == cell.type &&
        std::ranges::equal(edges, std::span(last_edges_).first(edges.size())))
      return element_;
    compute(i, cell, edges);
    std::ranges::copy(edges, last_edges_.begin());
    last_law_ = bulk_.law_of_cell[i];
    last_type_ = cell.type;
    return element_;
  }

private:
  void compute(std::size_t i, const Cell& cell, std::span<const Eigen::Vector3d> points) {
    const auto size = cell.node_count() * element::component_count(bulk_.section.physics);
    element_.resize(size, size);
    cell_stiffness(bulk_, i, cell.type, points, element_);
    if (cell.factor != 1)
      element_ *= cell.factor;
    require_finite(element_.diagonal(), cell, mesh_, "stiffness");
  }

  const mesh::Mesh& mesh_;
  const Bulk& bulk_;
  Eigen::MatrixXd element_;
  std::array<Eigen::Vector3d, 27> last_edges_;
  std::int32_t last_law_ = -1; ///< −1: there is none to compare with
  CellType last_type_ = CellType::point1;
};

/// Of the cells that `is_wanted` says, by their places in the bulk.
template <class Wanted>
SparseMatrix assemble_stiffness_of(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                                   std::span<const double> factors, const Wanted& is_wanted) {
  std::vector<Stiffnesses> stiffnesses(at(pattern.shares().count()), Stiffnesses(mesh, bulk));
  return sum_of_cells<Entries::blocks>(
      mesh, bulk, pattern, [&](int share, std::size_t i) -> const Eigen::MatrixXd* {
        return is_wanted(i) ? &stiffnesses[at(share)].of(i, Cell(mesh, bulk, factors, i)) : nullptr;
      });
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
  std::vector<Eigen::MatrixXd> elements(at(pattern.shares().count()));
  return sum_of_cells<Entries::diagonals>(mesh, bulk, pattern, [&](int share, std::size_t i) {
    const Cell cell(mesh, bulk, factors, i);
    auto& element = elements[at(share)];
    element.resize(cell.node_count(), cell.node_count());
    cell_mass(bulk, i, cell.type, cell.points, element);
    element *= cell.factor;
    require_finite(element.diagonal(), cell, mesh, "mass");
    return &element;
  });
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
