// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/assembly.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/index.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/element/hexa8_stiffness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace rubato::domain {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

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

/// Adds blocks of C × C numbers, their columns `stride` apart, to those at these places in the columns of a
/// node.
template <int C>
void add_blocks(const double* blocks, Eigen::Index stride, std::span<const std::int32_t> places,
                const NodeColumns<C>& columns) {
  for (const auto place : places) {
    const auto row = C * place;
    add_column<C>(blocks, columns[0] + row);
    add_column<C>(blocks + stride, columns[1] + row);
    if constexpr (C == 3)
      add_column<C>(blocks + 2 * stride, columns[2] + row);
    blocks += C;
  }
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

/// A matrix of the whole that cells add to. Columns become zero when a cell first reaches them: then they are
/// near when cells add to them, which is sooner done than to fetch zeros of the whole matrix from afar. Of
/// blocks with a diagonal only, cells give m of m ⊗ 1.
template <BlockEntries E> class Sum {
public:
  explicit Sum(const BlockPattern& pattern)
      : pattern_(pattern), matrix_(pattern.matrix_without_values(E)),
        is_clear_(at(matrix_.cols() / pattern.components()), 0) {}

  /// Adds those columns of an element matrix, node-major, whose nodes take part.
  template <class TakesPart>
  void add(CellIndex cell, std::span<const NodeIndex> nodes, const Eigen::MatrixXd& element,
           const TakesPart& takes_part) {
    const auto places = pattern_.places(cell, nodes.size());
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (takes_part(nodes[j]))
        add_column(pattern_.first_dof(nodes[j]), j, places.subspan(j * nodes.size(), nodes.size()), element);
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
  void add_column(int dof, std::size_t j, std::span<const std::int32_t> places,
                  const Eigen::MatrixXd& element) {
    clear(dof);
    if constexpr (E == BlockEntries::diagonal)
      add_diagonals(element.col(static_cast<Eigen::Index>(j)).data(), dof, places);
    else if (pattern_.components() == 3)
      add_all_blocks<3>(element, dof, j, places);
    else
      add_all_blocks<2>(element, dof, j, places);
  }

  template <int C>
  void add_all_blocks(const Eigen::MatrixXd& element, int dof, std::size_t j,
                      std::span<const std::int32_t> places) {
    add_blocks<C>(element.col(static_cast<Eigen::Index>(C * j)).data(), element.outerStride(), places,
                  columns_of_node<C>(matrix_, dof));
  }

  void add_diagonals(const double* values, int dof, std::span<const std::int32_t> places) {
    const int* outer = matrix_.outerIndexPtr() + dof;
    for (int b = 0; b < pattern_.components(); ++b)
      for (std::size_t i = 0; i < places.size(); ++i)
        matrix_.valuePtr()[outer[b] + places[i]] += values[i];
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

/// The sum of what `matrix_of` gives for each cell of the pattern, called with the share, the place in the
/// bulk and that of the cell which comes next, WorkShares::none after the last; null where a cell adds
/// nothing.
template <BlockEntries E, class MatrixOf>
SparseMatrix sum_of_cells(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                          const MatrixOf& matrix_of) {
  Sum<E> sum(pattern);
  const auto& shares = pattern.shares();
  const auto places = places_in_bulk(pattern, bulk);
  std::vector<Eigen::MatrixXd> kept(shares.border().size());
  shares.each_with_next([&](int share, std::size_t i, std::size_t next) {
    const Eigen::MatrixXd* element =
        matrix_of(share, places[i], next == WorkShares::none ? next : places[next]);
    if (element == nullptr)
      return;
    const auto cell = pattern.cells()[i];
    const auto border = shares.place_in_border(i);
    if (border < 0)
      return sum.add(cell, mesh.nodes_of(cell), *element, [](NodeIndex) { return true; });
    sum.add(cell, mesh.nodes_of(cell), *element, [&](NodeIndex node) { return !shares.is_shared(node); });
    kept[at(border)] = *element;
  });
  for (std::size_t b = 0; b < kept.size(); ++b) {
    const auto cell = pattern.cells()[shares.border()[b]];
    if (kept[b].size() > 0)
      sum.add(cell, mesh.nodes_of(cell), kept[b], [&](NodeIndex node) { return shares.is_shared(node); });
  }
  return sum.take();
}

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

  /// `i`: the place of the cell in the bulk, `next`: of the one that comes next. Times the factor of its law.
  const Eigen::MatrixXd& of(std::size_t i, std::size_t next, const Cell& cell) {
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
      if (!compute_with(next, cell))
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
  bool compute_with(std::size_t next, const Cell& cell) {
    if (next == WorkShares::none || !has_stiffness_of_edges(bulk_, next))
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
  std::size_t place_ahead_ = WorkShares::none;
  Eigen::MatrixXd element_ahead_; ///< of the cell there, without the factor
  LinearShape shape_ahead_;
};

/// Of the cells that `is_wanted` says, by their places in the bulk.
template <class Wanted>
SparseMatrix assemble_stiffness_of(const mesh::Mesh& mesh, const Bulk& bulk, const BlockPattern& pattern,
                                   std::span<const double> factors, const Wanted& is_wanted) {
  std::vector<Stiffnesses> stiffnesses(at(pattern.shares().count()), Stiffnesses(mesh, bulk));
  return sum_of_cells<BlockEntries::all>(
      mesh, bulk, pattern, [&](int share, std::size_t i, std::size_t next) -> const Eigen::MatrixXd* {
        return is_wanted(i) ? &stiffnesses[at(share)].of(i, next, Cell(mesh, bulk, factors, i)) : nullptr;
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
  return sum_of_cells<BlockEntries::diagonal>(mesh, bulk, pattern,
                                              [&](int share, std::size_t i, std::size_t) {
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
