// SPDX-License-Identifier: LGPL-3.0-or-later
/// The force and the moment that bodies transmit where they are cut, from nodal forces.
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/nonlinear_cells.hpp"
#include "rubato/domain/quadrature_states.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <span>
#include <vector>

namespace rubato::domain {

/// Internal forces of the cells on one side of a cut, summed over the nodes of the cut. They hold that side
/// in balance with all else that acts on it, exactly, however coarse its cells are; stresses that are
/// integrated over the cut do so only as the mesh is refined.
struct CutForces {
  /// Of constant cells. Rows: force along x, y, z [force/length], moment about x, y, z [force]; one column a
  /// dof. No rows: no cut.
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> of_displacement;
  /// The same of temperatures, one column a node of DofMap::nodes, and of reference temperatures: both are
  /// taken from that of displacements. No columns where nothing is heated.
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> of_temperature;
  Eigen::Matrix<double, 6, 1> of_reference = Eigen::Matrix<double, 6, 1>::Zero();

  struct Node {
    int first_dof = 0;
    Eigen::Vector3d arm; ///< of the undeformed node, from what moments are about [length]
  };
  /// Cells that are evaluated. Their forces hold moments in balance where the bodies are once they are
  /// deformed, those of small strain where they were.
  struct Evaluated {
    NonlinearCells cells;
    bool at_deformed = false;
  };
  std::vector<Node> nodes;          ///< the cut
  std::vector<Evaluated> evaluated; ///< none where all are constant
  int components = 0;

  bool empty() const { return of_displacement.rows() == 0; }
};

/// `cells`: those on one side, by their places in `bulk.cells`; `nodes`: the cut; moments are about `point`.
/// Springs on the nodes do not count, nor does damping. 2D: of the whole thickness; axisymmetric: of the
/// ring.
CutForces make_cut_forces(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                          std::span<const std::size_t> cells, std::span<const mesh::NodeIndex> nodes,
                          const Eigen::Vector3d& point, const Heat* heat = nullptr);

/// What the other side does to the cells of the cut at displacement `u` (size dof_count), with the heat of an
/// instant and where materials are as `states` have them, which must be there when cells are evaluated:
/// force, moment. Not finite where a cell has no forces.
Eigen::Matrix<double, 6, 1> forces_at(const CutForces& cut, const Eigen::VectorXd& u, HeatAt heat = {},
                                      const QuadratureStates* states = nullptr);

} // namespace rubato::domain
