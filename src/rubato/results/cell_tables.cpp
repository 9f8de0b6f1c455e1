// SPDX-License-Identifier: LGPL-3.0-or-later
// Tables of cells: at integration points, and of whole cells.
#include "rubato/cell/shape_table.hpp"
#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/element/element.hpp"
#include "rubato/material/expansion.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/ccx_points.hpp"
#include "rubato/results/cell_quantities.hpp"
#include "rubato/results/table_lines.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace rubato::results {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using study::ProbeField;

struct CellQuantity {
  std::string_view word;
  std::string_view heading;
  std::string_view total = {}; ///< of quantities of whole cells
};
constexpr std::array point_quantities{
    CellQuantity{"S", "stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) "},
    CellQuantity{"E", "strains (elem, integ.pnt.,exx,eyy,ezz,exy,exz,eyz) "},
    CellQuantity{"ME", "mechanical strains (elem, integ.pnt.,exx,eyy,ezz,exy,exz,eyz) "},
    CellQuantity{"PEEQ", "equivalent plastic strain (elem, integ.pnt.,pe)"},
    CellQuantity{"ENER", "internal energy density (elem, integ.pnt.,energy) "},
    CellQuantity{"COORD", "global coordinates (elem, integ.pnt.,x,y,z) "}};
constexpr std::array whole_quantities{
    CellQuantity{"ELSE", "internal energy (element, energy) ", "total internal energy "},
    CellQuantity{"ELKE", "kinetic energy (elem, energy) ", "total kinetic energy "},
    CellQuantity{"EVOL", "volume (element, volume) ", "total volume "}};

/// Places in the bulk of the cells of the table, ascending by number.
std::vector<std::size_t> cells_of(const TableSource& source) {
  const auto& bulk = source.model.bulk;
  std::vector<std::size_t> cells(bulk.cells.size());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  if (!source.table.on.empty()) {
    const auto* group = source.model.mesh.cell_group(source.table.on);
    std::erase_if(cells, [&](std::size_t cell) {
      return group == nullptr || !std::ranges::binary_search(group->items, bulk.cells[cell]);
    });
  }
  std::ranges::sort(cells, {}, [&](std::size_t cell) {
    return source.numbers.cells[static_cast<std::size_t>(bulk.cells[cell])];
  });
  return cells;
}

class CellTables {
public:
  explicit CellTables(const TableSource& source)
      : source_(source), model_(source.model), quantities_(source.model, source.now),
        cells_(cells_of(source)) {
    if (const auto* heat = model_.domain.heat())
      temperatures_ = heat->temperatures(source.now.t);
  }

  void add_points(const CellQuantity& quantity, TableText& text) {
    text.heading(quantity.heading, label_of(source_.table));
    for (const auto cell : cells_) {
      const auto& points = points_of(cell);
      const auto values = in_ccx_order(at_points(quantity.word, cell, points));
      std::int64_t number = 0;
      for (int layer = 0; layer < points.layers; ++layer)
        for (Index i = 0; i < values.cols(); ++i)
          text.line(number_of(cell), ++number, 4,
                    {values.data() + i * values.rows(), static_cast<std::size_t>(values.rows())});
    }
  }

  void add_cells(const CellQuantity& quantity, TableText& text) {
    if (has_lines(source_.table))
      text.heading(quantity.heading, label_of(source_.table));
    double sum = 0;
    for (const auto cell : cells_) {
      const double value = of_cell(quantity.word, cell);
      sum += value;
      if (has_lines(source_.table))
        text.line(number_of(cell), {&value, 1});
    }
    if (!has_totals(source_.table))
      return;
    text.heading(quantity.total, label_of(source_.table));
    text.indented(total_indent, {&sum, 1});
  }

private:
  std::int32_t number_of(std::size_t cell) const {
    return source_.numbers.cells[static_cast<std::size_t>(model_.bulk.cells[cell])];
  }
  CellType type_of(std::size_t cell) const { return model_.mesh.type_of(model_.bulk.cells[cell]); }
  std::span<const mesh::NodeIndex> nodes_of(std::size_t cell) const {
    return model_.mesh.nodes_of(model_.bulk.cells[cell]);
  }

  const CcxPoints& points_of(std::size_t cell) const {
    const auto* behaviour = model_.bulk.behaviour(cell);
    return ccx_points(type_of(cell),
                      behaviour != nullptr && behaviour->formulation == element::Formulation::reduced);
  }

  /// CalculiX has xz before yz.
  static MatrixXd in_ccx_order(MatrixXd values) {
    constexpr Index tensor = 6;
    if (values.rows() == tensor)
      values.row(4).swap(values.row(5));
    return values;
  }

  MatrixXd at_points(std::string_view word, std::size_t cell, const CcxPoints& points) {
    if (word == "COORD") {
      MatrixXd places(3, static_cast<Index>(nodes_of(cell).size()));
      for (Index i = 0; i < places.cols(); ++i)
        places.col(i) =
            model_.mesh.points[static_cast<std::size_t>(nodes_of(cell)[static_cast<std::size_t>(i)])];
      return places * points.from_nodes;
    }
    if (word == "PEEQ")
      return (quantities_.at_points(ProbeField::cumulated_plastic_strain, cell) * points.from_points)
          .cwiseMax(0.0);
    if (word == "S")
      return quantities_.at_points(ProbeField::stress, cell) * points.from_points;
    if (word == "E")
      return quantities_.at_points(ProbeField::strain, cell) * points.from_points;
    return word == "ME" ? mechanical_strain(cell) * points.from_points : energy_at(cell, points);
  }

  /// Tensors, without what expands freely.
  MatrixXd mechanical_strain(std::size_t cell) {
    MatrixXd strain = quantities_.at_points(ProbeField::strain, cell);
    const auto* heat = model_.domain.heat();
    const auto* expansion = heat != nullptr ? heat->expansion_of(cell) : nullptr;
    if (expansion == nullptr)
      return strain;
    material::FullExpansion free = material::expansion_strain(model_.bulk.law(cell), *expansion);
    free.tail<3>() /= 2;
    return strain - free * heat->degrees(cell, temperatures_).transpose();
  }

  /// ½ σ:ε of elastic materials, a row.
  static MatrixXd energy_density(const MatrixXd& stress, const MatrixXd& strain) {
    const MatrixXd products = stress.cwiseProduct(strain);
    return products.topRows(3).colwise().sum() / 2 + products.bottomRows(3).colwise().sum();
  }
  MatrixXd energy_at(std::size_t cell, const CcxPoints& points) {
    return energy_density(quantities_.at_points(ProbeField::stress, cell) * points.from_points,
                          mechanical_strain(cell) * points.from_points);
  }

  double kinetic_energy(std::size_t cell) const {
    const auto nodes = nodes_of(cell);
    const double density = material::density(model_.bulk.law(cell));
    if (density == 0 || source_.now.motion.v.size() == 0)
      return 0;
    const auto size = static_cast<Index>(nodes.size());
    MatrixXd mass = MatrixXd::Zero(size, size);
    element::mass(type_of(cell), domain::CellPoints(model_.mesh, nodes), density, model_.bulk.section, mass);
    MatrixXd velocity(size, model_.dofs.components);
    for (Index i = 0; i < size; ++i)
      for (int a = 0; a < model_.dofs.components; ++a)
        velocity(i, a) = source_.now.motion.v[model_.dofs.dof(nodes[static_cast<std::size_t>(i)], a)];
    return velocity.cwiseProduct(mass * velocity).sum() / 2;
  }

  double of_cell(std::string_view word, std::size_t cell) {
    if (word == "ELKE")
      return kinetic_energy(cell);
    const auto volumes = quantities_.volumes(cell);
    return word == "EVOL" ? volumes.sum() : (energy_at_own_points(cell) * volumes)(0);
  }

  /// Cells with points of lower order: the function through the energies there, whose integral is their sum.
  MatrixXd energy_at_own_points(std::size_t cell) {
    const auto& points = points_of(cell);
    if (points.to_points.size() > 0)
      return energy_at(cell, points) * points.to_points;
    return energy_density(quantities_.at_points(ProbeField::stress, cell), mechanical_strain(cell));
  }

  const TableSource& source_;
  const model::Model& model_;
  CellQuantities quantities_;
  std::vector<std::size_t> cells_;
  Eigen::VectorXd temperatures_;
};

} // namespace

void add_cell_tables(const TableSource& source, TableText& text) {
  CellTables tables(source);
  for (const auto& word : source.table.quantities) {
    if (const auto* at_points = std::ranges::find(point_quantities, word, &CellQuantity::word);
        at_points != point_quantities.end())
      tables.add_points(*at_points, text);
    if (const auto* whole = std::ranges::find(whole_quantities, word, &CellQuantity::word);
        whole != whole_quantities.end())
      tables.add_cells(*whole, text);
  }
}

} // namespace rubato::results
