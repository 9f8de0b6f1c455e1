// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/recovery.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/shape_table.hpp"
#include "rubato/domain/cell_matrices.hpp"
#include "rubato/linalg/dense_decompositions.hpp"

namespace rubato::domain {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using mesh::NodeIndex;

std::size_t slot(std::int64_t i) {
  return static_cast<std::size_t>(i);
}

MatrixXd extrapolation_of(const cell::ReferenceCell& cell) {
  const auto corners = cell::linear_type(cell.type);
  std::vector<cell::QuadraturePoint> nodes;
  for (const auto& xi : cell.nodes)
    nodes.push_back({xi, 1.});
  const MatrixXd at_points = cell::tabulate(corners, cell::stiffness_rule(cell.type)).values.transpose();
  const MatrixXd at_nodes = cell::tabulate(corners, nodes).values.transpose();
  return at_nodes * linalg::pseudo_inverse(at_points);
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
                         const Eigen::VectorXd& u, HeatAt heat)
    : mesh_(mesh), bulk_(bulk), dofs_(dofs), u_(u), heat_(heat.heat),
      temperatures_(heat.heat != nullptr ? heat.heat->temperatures(heat.t) : Eigen::VectorXd()) {}

MatrixXd CellTensors::at_points(Tensor what, std::size_t cell) {
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
  return at_points(what, cell) * extrapolation(mesh_.type_of(bulk_.cells[cell])).transpose();
}

NodalTensors nodal_tensors(Tensor what, const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                           const Eigen::VectorXd& u, HeatAt heat) {
  NodalTensors result = NodalTensors::Zero(6, mesh.node_count());
  std::vector<int> cells_at(mesh.points.size(), 0);
  CellTensors tensors(mesh, bulk, dofs, u, heat);
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const auto nodes = mesh.nodes_of(bulk.cells[i]);
    const auto at_nodes = tensors.at_nodes(what, i);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      result.col(nodes[n]) += at_nodes.col(static_cast<Index>(n));
      ++cells_at[slot(nodes[n])];
    }
  }
  for (const auto node : dofs.nodes)
    if (cells_at[slot(node)] > 0)
      result.col(node) /= cells_at[slot(node)];
  return result;
}

NodalStress nodal_stress(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                         const Eigen::VectorXd& u, HeatAt heat) {
  NodalStress result{nodal_tensors(Tensor::stress, mesh, bulk, dofs, u, heat),
                     Eigen::VectorXd::Zero(mesh.node_count())};
  for (const auto node : dofs.nodes)
    result.von_mises[node] = material::von_mises(result.stress.col(node));
  return result;
}

} // namespace rubato::domain
