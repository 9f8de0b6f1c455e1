// SPDX-License-Identifier: LGPL-3.0-or-later
/// The cells of a bulk whose forces are evaluated anew at every motion, laid out for that: what one
/// evaluation reads stands side by side.
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/evaluation.hpp"
#include "rubato/domain/quadrature_states.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::domain {

class NonlinearCells {
public:
  NonlinearCells() = default;
  /// Those of the bulk that are not constant. `pattern`: where their tangents are added.
  NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs, const SparseMatrix& pattern);

  bool empty() const { return cells_.empty(); }
  std::size_t record_count() const { return record_count_; }

  /// Adds forces and tangents at the end of the step to what is wanted, which has its size and pattern.
  Failed add(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
             const Wanted& wanted) const;

  /// Over a step.
  PlasticStep plastic_step(const QuadratureStates& old, const QuadratureStates& now) const;

private:
  /// Cells of one kind and law.
  struct Group {
    element::CellKind kind;
    material::PointLaw law;
    int nodes = 0;
    int points = 0;
    std::size_t state_size = 0;
  };
  struct Cell {
    mesh::CellIndex index = -1;
    int group = 0;
    std::size_t first_node = 0;   ///< in points_ and dofs_
    std::size_t first_place = 0;  ///< in places_
    std::size_t first_state = 0;  ///< in QuadratureStates::values
    std::size_t first_record = 0; ///< in QuadratureStates::records
  };
  struct Scratch;

  int group_of(const Bulk& bulk, std::size_t cell, CellType type);
  void add_cell(const mesh::Mesh& mesh, const DofMap& dofs, Cell cell);
  void find_places(const SparseMatrix& pattern);
  element::CellResult evaluate(const Cell& cell, const StepSpan& step, const QuadratureStates& old,
                               QuadratureStates& now, const Wanted& wanted, Scratch& scratch) const;
  void add_tangent(const Cell& cell, const std::vector<double>& tangent, SparseMatrix& matrix) const;

  int components_ = 0;
  std::vector<Group> groups_;
  std::vector<std::int32_t> law_of_group_;
  std::vector<Cell> cells_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<int> dofs_; ///< the first one of each node
  std::vector<std::int32_t>
      places_; ///< node by node: where the row block of one begins in the columns of another
  std::size_t record_count_ = 0;
};

} // namespace rubato::domain
