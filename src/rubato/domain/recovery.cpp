// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/recovery.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/shape_table.hpp"
#include "rubato/domain/balance.hpp"
#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/element/lower_order.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"

#include <algorithm>

namespace rubato::domain {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using mesh::NodeIndex;

std::size_t slot(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

/// The linear functions of the corners that fit values at `from` best, at `to`: to × from.
MatrixXd fit(CellType type, std::span<const cell::QuadraturePoint> from,
             std::span<const cell::QuadraturePoint> to) {
  const auto corners = cell::linear_type(type);
  const MatrixXd at_from = cell::tabulate(corners, from).values.transpose();
  const MatrixXd at_to = cell::tabulate(corners, to).values.transpose();
  return linalg::product(at_to, linalg::pseudo_inverse(at_from));
}

MatrixXd extrapolation_of(const cell::ReferenceCell& cell) {
  std::vector<cell::QuadraturePoint> nodes;
  for (const auto& xi : cell.nodes)
    nodes.push_back({xi, 1.});
  return fit(cell.type, cell::stiffness_rule(cell.type), nodes);
}

/// From the points of element::lower_order_rule to those of cell::stiffness_rule.
const MatrixXd& from_lower_order(CellType type) {
  static const auto all = [] {
    std::array<MatrixXd, cell_type_count> table;
    for (const auto& cell : cell::all_topologies())
      if (element::has_lower_order_rule(cell.type))
        table[static_cast<std::size_t>(cell.type)] =
            element::from_lower_order_points(cell.type, cell::stiffness_rule(cell.type));
    return table;
  }();
  return all[static_cast<std::size_t>(type)];
}

/// A Bᵀ, A with few rows.
MatrixXd times_transposed(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd sum = MatrixXd::Zero(a.rows(), b.rows());
  for (Index j = 0; j < b.rows(); ++j)
    for (Index k = 0; k < b.cols(); ++k)
      for (Index i = 0; i < a.rows(); ++i)
        sum(i, j) += a(i, k) * b(j, k);
  return sum;
}

using Table = std::array<MatrixXd, cell_type_count>;

Table every_extrapolation() {
  Table table;
  for (const auto& cell : cell::all_topologies())
    if (cell::has_reference_cell(cell.type))
      table[static_cast<std::size_t>(cell.type)] = extrapolation_of(cell::reference_cell(cell.type));
  return table;
}

void gather(const DofMap& dofs, std::span<const NodeIndex> nodes, const Eigen::VectorXd& u,
            std::vector<double>& local) {
  local.clear();
  for (const auto node : nodes)
    for (int a = 0; a < dofs.components; ++a)
      local.push_back(u[dofs.dof(node, a)]);
}

/// All six stresses or strains of a strain of the physics.
Eigen::Matrix<double, 6, 1> full(Tensor what, const material::Law& law, study::Physics physics,
                                 const material::Voigt& strain, const study::ThermalExpansion* expansion,
                                 double degrees) {
  if (expansion != nullptr)
    return what == Tensor::strain ? material::heated_strain(law, physics, strain, *expansion, degrees)
                                  : material::heated_stress(law, physics, strain, *expansion, degrees);
  if (what == Tensor::strain)
    return material::full_strain(law, physics, strain);
  return material::full_stress(law, physics, material::stress(law, physics, strain));
}

} // namespace

const MatrixXd& extrapolation(CellType type) {
  static const Table table = every_extrapolation();
  return table[static_cast<std::size_t>(cell::reference_cell(type).type)];
}

CellTensors::CellTensors(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                         const Eigen::VectorXd& u, HeatAt heat, const QuadratureStates* states)
    : mesh_(mesh), bulk_(bulk), dofs_(dofs), u_(u), heat_(heat.heat),
      temperatures_(heat_ != nullptr ? heat_->temperatures(heat.t) : Eigen::VectorXd()), states_(states) {
  std::size_t first = 0;
  for (std::size_t i = 0; !bulk.behaviours.empty() && i < bulk.cells.size(); ++i) {
    first_state_.push_back(first);
    const auto size = state_size(mesh, bulk, i);
    first += size;
    untouched_.resize(std::max(untouched_.size(), size), 0.0);
  }
}

std::span<const double> CellTensors::states_of(std::size_t cell) const {
  const auto size = state_size(mesh_, bulk_, cell);
  if (states_ == nullptr)
    return std::span(untouched_).first(size);
  return std::span(states_->values).subspan(first_state_[cell], size);
}

std::span<const double> CellTensors::state_at(const Behaviour& behaviour, std::size_t cell,
                                              std::size_t point) const {
  const auto size = slot(material::state_size(behaviour.law));
  return states_of(cell).subspan(point * size, size);
}

MatrixXd CellTensors::at_points(Tensor what, std::size_t cell) {
  if (const auto* behaviour = bulk_.behaviour(cell))
    return nonlinear_at_points(what, *behaviour, cell);
  return what == Tensor::plastic_strain
             ? MatrixXd::Zero(6, extrapolation(mesh_.type_of(bulk_.cells[cell])).cols())
             : linear_at_points(what, cell);
}

namespace {

/// In plane stress with what the law has made of it across the plane.
material::Strain6 whole_strain(const material::PointLaw& law, const element::PointRecord& record,
                               std::span<const double> state) {
  auto strain = record.strain;
  if (std::holds_alternative<material::PlaneStress>(law))
    strain[2] = material::strain_across(state);
  return strain;
}

/// What the law saw and what expanded freely; of hyperelastic laws, which see F/(1 + a), of F itself.
material::Strain6 heated_strain(const material::PointLaw& law, const material::Strain6& seen,
                                const material::Strain6& free) {
  if (has_linear_stress(law))
    return seen + free;
  const double a = free[0];
  material::Strain6 strain = (1 + a) * (1 + a) * seen;
  strain.head<3>().array() += a * (1 + a / 2);
  return strain;
}

/// Engineering shears become those of a tensor.
Eigen::Matrix<double, 6, 1> as_tensor(const material::Strain6& strain) {
  Eigen::Matrix<double, 6, 1> tensor = strain;
  tensor.tail<3>() /= 2;
  return tensor;
}

/// At the points of cell::stiffness_rule, of values at the points of the cell: one point counts for all.
MatrixXd at_each_point(const MatrixXd& values, const element::CellKind& kind) {
  if (kind.formulation == element::Formulation::lower_order)
    return times_transposed(values, from_lower_order(kind.type));
  MatrixXd all(values.rows(), extrapolation(kind.type).cols());
  for (Index q = 0; q < all.cols(); ++q)
    all.col(q) = values.col(q % values.cols());
  return all;
}

} // namespace

/// The law answers from where it is to the same strain: as it did at the end of the step.
MatrixXd CellTensors::nonlinear_at_points(Tensor what, const Behaviour& behaviour, std::size_t cell) {
  const auto [block, index] = mesh_.place_of(bulk_.cells[cell]);
  const auto nodes = block->cell(index);
  const auto kind = kind_of(bulk_, behaviour, block->type);
  const auto count = slot(element::point_count(kind));
  MatrixXd result(6, static_cast<Index>(count));
  if (what == Tensor::plastic_strain) {
    for (std::size_t q = 0; q < count; ++q)
      result.col(static_cast<Index>(q)) =
          as_tensor(material::plastic_strain(behaviour.law, state_at(behaviour, cell, q)));
    return at_each_point(result, kind);
  }
  gather(dofs_, nodes, u_, local_);
  const CellPoints points(mesh_, nodes);
  const auto old = states_of(cell);
  std::vector<double> now(old.size());
  std::vector<double> force(local_.size());
  std::vector<element::PointRecord> records(count);
  std::vector<material::Strain6> free;
  if (heat_ != nullptr && behaviour.expansion)
    heat_->put_free_strains(cell, temperatures_, *behaviour.expansion, free);
  element::evaluate(kind, element::PointLaws(behaviour.law), {points, local_, old, {}, {}, free},
                    {now, force, {}, records});
  const auto size = slot(material::state_size(behaviour.law));
  for (std::size_t q = 0; q < count; ++q) {
    const auto seen = whole_strain(behaviour.law, records[q], std::span(now).subspan(q * size, size));
    result.col(static_cast<Index>(q)) = what == Tensor::stress
                                            ? records[q].cauchy
                                            : as_tensor(heated_strain(behaviour.law, seen, records[q].free));
  }
  return at_each_point(result, kind);
}

/// Cumulated plastic strain is never negative at points; its extrapolation to nodes may be.
MatrixXd CellTensors::cumulated_plastic_strain_at_nodes(std::size_t cell) {
  MatrixXd values =
      times_transposed(cumulated_plastic_strain(cell), extrapolation(mesh_.type_of(bulk_.cells[cell])));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values(i) = std::max(0.0, values(i));
  return values;
}

MatrixXd CellTensors::cumulated_plastic_strain(std::size_t cell) {
  const auto type = mesh_.type_of(bulk_.cells[cell]);
  const auto* behaviour = bulk_.behaviour(cell);
  if (behaviour == nullptr)
    return MatrixXd::Zero(1, extrapolation(type).cols());
  const auto kind = kind_of(bulk_, *behaviour, type);
  MatrixXd result(1, element::point_count(kind));
  for (Index q = 0; q < result.cols(); ++q)
    result(0, q) = material::cumulated_plastic_strain(behaviour->law, state_at(*behaviour, cell, slot(q)));
  return at_each_point(result, kind);
}

MatrixXd CellTensors::linear_at_points(Tensor what, std::size_t cell) {
  const auto physics = bulk_.section.physics;
  const auto [block, index] = mesh_.place_of(bulk_.cells[cell]);
  const auto nodes = block->cell(index);
  gather(dofs_, nodes, u_, local_);
  strain_.resize(material::strain_size(physics), extrapolation(block->type).cols());
  const CellPoints points(mesh_, nodes);
  element::strains(block->type, points, physics, local_, strain_);
  const auto* expansion = heat_ != nullptr ? heat_->expansion_of(cell) : nullptr;
  const Eigen::VectorXd degrees = expansion != nullptr ? heat_->degrees(cell, temperatures_)
                                                       : Eigen::VectorXd::Zero(strain_.cols()).eval();
  const PointLaws laws(bulk_, cell, block->type, points);
  MatrixXd result(6, strain_.cols());
  for (Index q = 0; q < strain_.cols(); ++q)
    result.col(q) = full(what, laws[q], physics, strain_.col(q), expansion, degrees[q]);
  return result;
}

MatrixXd CellTensors::at_nodes(Tensor what, std::size_t cell) {
  return times_transposed(at_points(what, cell), extrapolation(mesh_.type_of(bulk_.cells[cell])));
}

namespace {

/// What `of_cell(tensors, cell)` gives at the nodes of each cell, averaged at each node over its cells.
/// Threads compute some cells at a time, which are then summed in their order.
template <class OfCell>
MatrixXd averaged(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs, const CellTensors& tensors,
                  const Threads& threads, Index rows, const OfCell& of_cell) {
  constexpr std::size_t at_once = 4096, fewest = 256;
  MatrixXd result = MatrixXd::Zero(rows, mesh.node_count());
  std::vector<int> cells_at(mesh.points.size(), 0);
  std::vector<CellTensors> own(slot(threads.parts_of(bulk.cells.size(), fewest)), tensors);
  std::vector<MatrixXd> at_nodes(std::min(at_once, bulk.cells.size()));
  for (std::size_t first = 0; first < bulk.cells.size(); first += at_once) {
    const auto count = std::min(at_once, bulk.cells.size() - first);
    threads.each(static_cast<int>(own.size()), [&](int part) {
      const auto p = slot(part);
      for (auto i = count * p / own.size(); i < count * (p + 1) / own.size(); ++i)
        at_nodes[i] = of_cell(own[p], first + i);
    });
    for (std::size_t i = 0; i < count; ++i) {
      const auto nodes = mesh.nodes_of(bulk.cells[first + i]);
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        result.col(nodes[n]) += at_nodes[i].col(static_cast<Index>(n));
        ++cells_at[slot(nodes[n])];
      }
    }
  }
  for (const auto node : dofs.nodes)
    if (cells_at[slot(node)] > 0)
      result.col(node) /= cells_at[slot(node)];
  return result;
}

} // namespace

NodalTensors nodal_tensors(Tensor what, const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                           const Eigen::VectorXd& u, HeatAt heat, const QuadratureStates* states,
                           const Threads& threads) {
  const CellTensors tensors(mesh, bulk, dofs, u, heat, states);
  return averaged(mesh, bulk, dofs, tensors, threads, 6,
                  [&](CellTensors& own, std::size_t i) { return own.at_nodes(what, i); });
}

Eigen::VectorXd nodal_plastic_strain(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                                     const Eigen::VectorXd& u, HeatAt heat, const QuadratureStates* states,
                                     const Threads& threads) {
  const CellTensors tensors(mesh, bulk, dofs, u, heat, states);
  const auto of_cell = [&](CellTensors& own, std::size_t i) -> MatrixXd {
    return own.cumulated_plastic_strain_at_nodes(i);
  };
  return averaged(mesh, bulk, dofs, tensors, threads, 1, of_cell).transpose();
}

NodalStress nodal_stress(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                         const Eigen::VectorXd& u, HeatAt heat, const QuadratureStates* states,
                         const Threads& threads) {
  NodalStress result{nodal_tensors(Tensor::stress, mesh, bulk, dofs, u, heat, states, threads),
                     Eigen::VectorXd::Zero(mesh.node_count())};
  for (const auto node : dofs.nodes)
    result.von_mises[node] = material::von_mises(result.stress.col(node));
  return result;
}

} // namespace rubato::domain
