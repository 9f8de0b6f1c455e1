// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/heat.hpp"

#include "rubato/cell/shape_table.hpp"
#include "rubato/core/error.hpp"
#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/element/element.hpp"
#include "rubato/element/lower_order.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::domain {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Entries = std::vector<Eigen::Triplet<double, int>>;

/// What multiplies the function of time, of each node; empty where it changes with time itself.
std::vector<double> amounts_of(const HeatedNodes& nodes) {
  std::vector<double> amounts;
  const auto& value = nodes.value;
  if ((value.expression && value.expression->has('t')) || (value.sampled && value.sampled->varies_in_time()))
    return amounts;
  for (const auto& place : nodes.places)
    amounts.push_back(nodes.value.multiplied_at(place, 0));
  return amounts;
}

void add_entries(const MatrixXd& matrix, std::span<const int> rows, std::span<const int> columns,
                 Entries& entries) {
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < matrix.rows(); ++i)
      entries.emplace_back(rows[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)],
                           matrix(i, j));
}

/// Of each row of the matrix, whose values are column by column.
VectorXd sums_of_rows(const MatrixXd& matrix) {
  VectorXd sums = VectorXd::Zero(matrix.rows());
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < matrix.rows(); ++i)
      sums[i] += matrix(i, j);
  return sums;
}

void add_at(std::span<const int> places, double factor, const VectorXd& values, VectorXd& sum) {
  for (std::size_t i = 0; i < places.size(); ++i)
    sum[places[i]] += factor * values[static_cast<Index>(i)];
}

/// Σ N_i h N_j over the points, N a column a point.
MatrixXd weighted_squares(const MatrixXd& shapes, const VectorXd& weights) {
  MatrixXd sum = MatrixXd::Zero(shapes.rows(), shapes.rows());
  for (Index q = 0; q < shapes.cols(); ++q)
    for (Index j = 0; j < shapes.rows(); ++j)
      for (Index i = 0; i < shapes.rows(); ++i)
        sum(i, j) += shapes(i, q) * weights[q] * shapes(j, q);
  return sum;
}

void multiply(const Eigen::SparseMatrix<double, Eigen::RowMajor, int>& matrix, const VectorXd& x,
              VectorXd& y) {
  y.resize(matrix.rows());
  for (Index row = 0; row < matrix.outerSize(); ++row) {
    double sum = 0;
    for (Eigen::SparseMatrix<double, Eigen::RowMajor, int>::InnerIterator entry(matrix, row); entry; ++entry)
      sum += entry.value() * x[entry.col()];
    y[row] = sum;
  }
}

/// Shape functions at the points at which the cell evaluates its law.
const MatrixXd& shapes_of(const Bulk& bulk, std::size_t cell, CellType type) {
  const auto* behaviour = bulk.behaviour(cell);
  if (behaviour == nullptr ||
      kind_of(bulk, *behaviour, type).formulation != element::Formulation::lower_order)
    return cell::stiffness_table(type).values;
  return element::lower_order_table(type).values;
}

} // namespace

VectorXd Heat::Forces::at(const VectorXd& temperatures) const {
  VectorXd forces;
  multiply(matrix, temperatures, forces);
  forces -= reference;
  return forces;
}

Heat::Heat(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
           std::vector<std::optional<study::ThermalExpansion>> expansions, std::vector<HeatedNodes> nodes)
    : expansions_(std::move(expansions)), nodes_(std::move(nodes)),
      node_count_(static_cast<Index>(dofs.nodes.size())) {
  std::ranges::transform(nodes_, std::back_inserter(amounts_), amounts_of);
  choose_cells(mesh, bulk, dofs);
  assemble(mesh, bulk, dofs);
}

void Heat::choose_cells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs) {
  std::vector<char> given(static_cast<std::size_t>(node_count_), 0);
  for (const auto& part : nodes_)
    for (const int node : part.nodes)
      given[static_cast<std::size_t>(node)] = 1;
  const auto has_one = [&](int node) { return given[static_cast<std::size_t>(node)] != 0; };
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const auto type = mesh.type_of(bulk.cells[i]);
    Cell cell{type, -1, {}, &shapes_of(bulk, i, type)};
    for (const auto node : mesh.nodes_of(bulk.cells[i]))
      cell.nodes.push_back(dofs.dof(node, 0) / dofs.components);
    const int law = bulk.law_of_cell[i];
    if (expansions_[static_cast<std::size_t>(law)] && std::ranges::any_of(cell.nodes, has_one)) {
      const auto bare = std::ranges::find_if_not(cell.nodes, has_one);
      if (bare != cell.nodes.end())
        throw InputError(fmt::format("{} has nodes with and without a temperature; expected one for node {}, "
                                     "too, for example the reference temperature, or 'on: all'",
                                     cell_label(mesh, bulk.cells[i]),
                                     mesh::node_name(mesh, dofs.nodes[static_cast<std::size_t>(*bare)])));
      cell.law = law;
    }
    cells_.push_back(std::move(cell));
  }
}

const study::ThermalExpansion* Heat::expansion_of(std::size_t cell) const {
  const int law = cells_[cell].law;
  return law < 0 ? nullptr : &*expansions_[static_cast<std::size_t>(law)];
}

/// Energy: ½ Tᵀ H T − T·H 1 reference + ½ reference² 1·H 1 with H = ∫ N_i e·D e N_j.
CellHeat Heat::cell_heat(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell) const {
  const auto physics = bulk.section.physics;
  const auto type = cells_[cell].type;
  const auto nodes = static_cast<Index>(cells_[cell].nodes.size());
  const auto& expansion = *expansion_of(cell);
  const auto& shapes = cell::stiffness_table(type).values;
  const CellPoints points(mesh, mesh.nodes_of(bulk.cells[cell]));
  const auto count = shapes.cols();
  MatrixXd stress(material::strain_size(physics), count);
  VectorXd held(count);
  element::point_volumes(type, points, bulk.section, held);
  const PointLaws laws(bulk, cell, type, points);
  for (Index q = 0; q < count; ++q) {
    stress.col(q) = material::stress(laws[q], physics, material::free_strain(laws[q], physics, expansion));
    held[q] *= material::held_energy(laws[q], physics, expansion);
  }
  CellHeat heat;
  heat.force.resize(nodes * element::component_count(physics), nodes);
  element::stress_forces(type, points, bulk.section, stress, heat.force);
  heat.reference_force = sums_of_rows(heat.force);
  heat.reference_force *= expansion.reference;
  heat.energy = weighted_squares(shapes, held);
  return heat;
}

std::vector<int> Heat::dofs_of(std::size_t cell, const DofMap& dofs) const {
  std::vector<int> rows;
  for (const int node : cells_[cell].nodes)
    for (int a = 0; a < dofs.components; ++a)
      rows.push_back(node * dofs.components + a);
  return rows;
}

void Heat::assemble(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs) {
  std::array<Entries, 2> forces; // of cells of constant stiffness, of others
  Entries energies;
  constant_.reference = evaluated_.reference = VectorXd::Zero(dofs.dof_count);
  reference_energy_ = VectorXd::Zero(node_count_);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].law < 0)
      continue;
    const auto heat = cell_heat(mesh, bulk, i);
    const auto& nodes = cells_[i].nodes;
    const auto rows = dofs_of(i, dofs);
    const bool constant = bulk.is_constant(i);
    add_entries(heat.force, rows, nodes, forces[constant ? 0 : 1]);
    add_at(rows, 1, heat.reference_force, (constant ? constant_ : evaluated_).reference);
    if (!constant)
      continue;
    add_entries(heat.energy, nodes, nodes, energies);
    const double reference = expansion_of(i)->reference;
    const auto of_nodes = sums_of_rows(heat.energy);
    add_at(nodes, reference, of_nodes, reference_energy_);
    reference_constant_ += 0.5 * reference * reference * of_nodes.sum();
  }
  constant_.matrix.resize(dofs.dof_count, node_count_);
  constant_.matrix.setFromTriplets(forces[0].begin(), forces[0].end());
  evaluated_.matrix.resize(dofs.dof_count, node_count_);
  evaluated_.matrix.setFromTriplets(forces[1].begin(), forces[1].end());
  energy_.resize(node_count_, node_count_);
  energy_.setFromTriplets(energies.begin(), energies.end());
}

VectorXd Heat::temperatures(double t) const {
  VectorXd temperatures = VectorXd::Zero(node_count_);
  for (std::size_t p = 0; p < nodes_.size(); ++p) {
    const auto& [value, nodes, places] = nodes_[p];
    const auto& amounts = amounts_[p];
    const double factor = value.function ? value_at(*value.function, t) : 1.0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      temperatures[nodes[i]] = amounts.empty() ? value.at(places[i], t) : factor * amounts[i];
  }
  return temperatures;
}

VectorXd Heat::force(double t) const {
  return constant_.at(temperatures(t));
}

double Heat::largest_force(double t) const {
  const auto now = temperatures(t);
  const auto constant = constant_.at(now);
  const auto evaluated = evaluated_.at(now);
  double largest = 0;
  for (Index i = 0; i < constant.size(); ++i)
    largest = std::max(largest, std::abs(constant[i] + evaluated[i]));
  return largest;
}

double Heat::held_energy(double t) const {
  const auto now = temperatures(t);
  VectorXd of_nodes;
  multiply(energy_, now, of_nodes);
  return 0.5 * now.dot(of_nodes) - reference_energy_.dot(now) + reference_constant_;
}

VectorXd Heat::degrees(std::size_t cell, const VectorXd& temperatures) const {
  const auto& shapes = *cells_[cell].shapes;
  const auto& nodes = cells_[cell].nodes;
  const double reference = expansion_of(cell)->reference;
  VectorXd degrees(shapes.cols());
  for (Index q = 0; q < shapes.cols(); ++q) {
    double sum = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      sum += shapes(static_cast<Index>(n), q) * temperatures[nodes[n]];
    degrees[q] = sum - reference;
  }
  return degrees;
}

void Heat::put_free_strains(std::size_t cell, const VectorXd& temperatures,
                            const material::FullExpansion& expansion,
                            std::vector<material::Strain6>& strains) const {
  strains.clear();
  if (expansion_of(cell) == nullptr)
    return;
  for (const double excess : degrees(cell, temperatures))
    strains.push_back(excess * expansion);
}

} // namespace rubato::domain
