// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/recovery.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/shape_table.hpp"
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

/// Full stresses at the quadrature points, 6 × points.
MatrixXd point_stresses(const material::Law& law, study::Physics physics, const MatrixXd& strain) {
  MatrixXd result(6, strain.cols());
  for (Index q = 0; q < strain.cols(); ++q)
    result.col(q) = material::full_stress(law, physics, material::stress(law, physics, strain.col(q)));
  return result;
}

} // namespace

const MatrixXd& extrapolation(CellType type) {
  static const Table table = every_extrapolation();
  return table[static_cast<std::size_t>(cell::reference_cell(type).type)];
}

NodalStress nodal_stress(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                         const Eigen::VectorXd& u) {
  const auto physics = bulk.section.physics;
  NodalStress result{Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, mesh.node_count()),
                     Eigen::VectorXd::Zero(mesh.node_count())};
  std::vector<int> cells_at(mesh.points.size(), 0);
  std::vector<double> local;
  MatrixXd strain;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const auto [block, index] = mesh.place_of(bulk.cells[i]);
    const auto nodes = block->cell(index);
    const auto& to_nodes = extrapolation(block->type);
    gather(dofs, nodes, u, local);
    strain.resize(material::strain_size(physics), to_nodes.cols());
    element::strains(block->type, CellPoints(mesh, nodes), physics, local, strain);
    const MatrixXd at_nodes = point_stresses(bulk.law(i), physics, strain) * to_nodes.transpose();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      result.stress.col(nodes[n]) += at_nodes.col(static_cast<Index>(n));
      ++cells_at[slot(nodes[n])];
    }
  }
  for (const auto node : dofs.nodes) {
    if (cells_at[slot(node)] > 0)
      result.stress.col(node) /= cells_at[slot(node)];
    result.von_mises[node] = material::von_mises(result.stress.col(node));
  }
  return result;
}

} // namespace rubato::domain
