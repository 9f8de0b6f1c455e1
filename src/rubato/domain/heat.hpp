// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies that expand with their temperature. Those of constant stiffness have forces f_int(u, t) = K u −
/// f(T(t)), f linear in the temperatures of the nodes, which shape functions take to the points of
/// cell::stiffness_rule. The laws of others see what is left of their strain (NonlinearCells).
#pragma once

#include "rubato/core/field_function.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/material/expansion.hpp"
#include "rubato/material/point_law.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <optional>
#include <vector>

namespace rubato::domain {

/// The temperature of some nodes as a function of time.
struct HeatedNodes {
  FieldFunction value;    ///< [temperature]
  std::vector<int> nodes; ///< places in DofMap::nodes
  std::vector<std::array<double, 3>> places;
};

/// What a cell does by its temperatures: forces `force` T − `reference_force` on its dofs.
struct CellHeat {
  Eigen::MatrixXd force;           ///< nodes · d × nodes [force/temperature]
  Eigen::VectorXd reference_force; ///< [force]
  Eigen::MatrixXd energy;          ///< nodes × nodes [force · length/temperature²]
};

class Heat {
public:
  /// `expansions`: one a law of the bulk. A cell is heated when its law expands and all its nodes have a
  /// temperature. Throws InputError, with the cell, where only some of them have one.
  Heat(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
       std::vector<std::optional<study::ThermalExpansion>> expansions, std::vector<HeatedNodes> nodes);

  /// One a node of DofMap::nodes, 0 where none is given [temperature]. Throws what values throw.
  Eigen::VectorXd temperatures(double t) const;
  /// f(T(t)), one a dof: ∫ Bᵀ D e ϑ of the cells of constant stiffness, ϑ = T − reference [force].
  Eigen::VectorXd force(double t) const;
  /// The largest ∫ Bᵀ D e ϑ at any dof of all heated cells, with the laws of the bulk [force].
  double largest_force(double t) const;
  /// ½ ∫ e·D e ϑ²: what bodies of constant stiffness would store if they could not move at all
  /// [force · length].
  double held_energy(double t) const;

  /// Of a cell by its place in Bulk::cells; null where temperature does nothing.
  const study::ThermalExpansion* expansion_of(std::size_t cell) const;
  /// ϑ at the points of cell::stiffness_rule of a heated cell.
  Eigen::VectorXd degrees(std::size_t cell, const Eigen::VectorXd& temperatures) const;
  /// What expands freely at these points of a cell whose law has the expansion: nothing of cells that are not
  /// heated.
  void put_free_strains(std::size_t cell, const Eigen::VectorXd& temperatures,
                        const material::FullExpansion& expansion,
                        std::vector<material::Strain6>& strains) const;
  /// Of a heated cell.
  CellHeat cell_heat(const mesh::Mesh& mesh, const Bulk& bulk, std::size_t cell) const;
  /// Places of its nodes in DofMap::nodes.
  const std::vector<int>& nodes_of(std::size_t cell) const { return cells_[cell].nodes; }

private:
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

  struct Cell {
    CellType type{};
    int law = -1; ///< below 0: not heated
    std::vector<int> nodes;
    const Eigen::MatrixXd* shapes = nullptr; ///< of its nodes at its points, nodes × points
  };

  void choose_cells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs);
  void assemble(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs);
  std::vector<int> dofs_of(std::size_t cell, const DofMap& dofs) const;

  std::vector<std::optional<study::ThermalExpansion>> expansions_;
  std::vector<HeatedNodes> nodes_;
  std::vector<std::vector<double>> amounts_; ///< of nodes whose values times a function of time are constant
  Eigen::Index node_count_ = 0;
  std::vector<Cell> cells_;
  /// `matrix` T − `reference`.
  struct Forces {
    Sparse matrix; ///< dofs × nodes
    Eigen::VectorXd reference;
    Eigen::VectorXd at(const Eigen::VectorXd& temperatures) const;
  };
  Forces constant_;  ///< of cells of constant stiffness
  Forces evaluated_; ///< of the others, for the size of their forces
  Sparse energy_;    ///< nodes × nodes
  Eigen::VectorXd reference_energy_;
  double reference_constant_ = 0;
};

/// Heat at an instant; none where `heat` is null.
struct HeatAt {
  const Heat* heat = nullptr;
  double t = 0;
};

} // namespace rubato::domain
