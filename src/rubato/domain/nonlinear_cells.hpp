// SPDX-License-Identifier: LGPL-3.0-or-later
/// The cells of a bulk whose forces are evaluated anew at every motion, laid out for that: what one
/// evaluation reads stands side by side.
#pragma once

#include "rubato/domain/balance.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/evaluation.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/quadrature_states.hpp"
#include "rubato/domain/work_shares.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace rubato::domain {

struct PathPart;

class NonlinearCells {
public:
  NonlinearCells() = default;
  /// Those of the bulk that are not constant. What they give does not depend on the number of threads.
  NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs, const Threads& threads = {});
  /// Some of them, by their places in the bulk, ascending. States and points of paths are those of the whole
  /// bulk, records those of these cells.
  NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                 std::span<const std::size_t> cells, const Threads& threads = {});

  /// Tangents may be asked for from now on; `pattern`: where they are added.
  void find_places(const SparseMatrix& pattern);
  /// `growth` may be asked for from now on. `mass_factors`: what multiplies the mass of each cell of
  /// Bulk::cells; empty: nothing.
  void find_rates(const mesh::Mesh& mesh, const Bulk& bulk, std::span<const double> mass_factors);

  bool empty() const { return cells_.empty(); }
  std::size_t record_count() const { return record_count_; }
  /// Of any cell of the bulk.
  bool has_finite_strain() const { return has_finite_strain_; }
  /// Whether the work of the forces of any cell of the bulk over a step may be another than what laws and
  /// hourglasses take of it.
  bool has_own_scheme() const { return has_own_scheme_; }

  /// Adds forces and tangents at the end of the step to what is wanted, which has its size and pattern.
  /// `heat`: of the bulk; null: nothing is heated.
  Failed add(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now, const Wanted& wanted,
             const Heat* heat) const;

  /// Over a step.
  PlasticStep plastic_step(const QuadratureStates& old, const QuadratureStates& now) const;
  /// Of a step from `old` to `now`. Throws std::invalid_argument when one of them has no records.
  Balance balance(const QuadratureStates& old, const QuadratureStates& now) const;
  /// What back stresses store, of states with records [force · length].
  double back_stress_energy(const QuadratureStates& states) const;

  /// Stored in hourglasses of reduced cells [force · length].
  double hourglass_energy(const Eigen::VectorXd& u) const;

  /// y += K x, K the tangent where nothing has happened yet.
  void add_initial_product(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

  /// By what the largest λ of the whole may have grown since nothing had happened, by the cells of finite
  /// strain: max κ min(1, λ_e/λ), κ the growth of the stiffness of a cell, λ_e its own λ at first
  /// (cell_rates.hpp), `rate`: λ of the whole at first [1/time²]. With logarithmic strain κ is by the height
  /// of a cell and its stress, which the path has, else by the stiffness of its shortest waves. Quadratic
  /// cells, which have no such waves: max κ λ_e/λ, not below the true growth, κ by the norm of their
  /// stiffness. `heat`: at instant t; null: nothing is heated.
  double growth(const Eigen::VectorXd& u, const QuadratureStates& states, const LawPath& path, double rate,
                const Heat* heat, double t) const;

private:
  /// Cells of one kind and law.
  struct Group {
    element::CellKind kind;
    material::PointLaw law;
    int nodes = 0;
    int points = 0;
    std::size_t state_size = 0;
    bool followed = false;                                               ///< whether a path has its points
    bool stress_is_linear = true;                                        ///< has_linear_stress
    material::FullExpansion expansion = material::FullExpansion::Zero(); ///< 0: it does not expand
    element::CellKind undeformed;                                        ///< small strain
    material::ElasticPoint first; ///< the law's tangent where nothing has happened
    Eigen::MatrixXd waves;        ///< cell::shortest_waves
  };
  struct Cell {
    mesh::CellIndex index = -1;
    std::size_t place = 0; ///< in Bulk::cells
    int group = 0;
    std::size_t first_node = 0;   ///< in points_ and dofs_
    std::size_t first_place = 0;  ///< in places_
    std::size_t first_state = 0;  ///< in QuadratureStates::values
    std::size_t first_record = 0; ///< in QuadratureStates::records
    std::size_t first_follow = 0; ///< in LawPath::points
  };
  /// Of one cell where nothing has happened.
  struct Rate {
    double stiffness = 0; ///< of its shortest waves, or ‖K_e‖ where it has none [force/length]
    double lambda = 0;    ///< bound of its own λ [1/time²]
  };
  /// Storage of one cell at a time.
  struct Scratch {
    std::vector<double> before, displacement, force, tangent, states;
    std::vector<Eigen::Vector3d> places;
    std::vector<element::PointRecord> records;
    Eigen::VectorXd temperatures; ///< of an instant, as Heat has them; empty: nothing is heated
    std::vector<material::Strain6> free;
  };

  void add_cells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                 const std::function<bool(std::size_t)>& has);
  void note(const element::CellKind& kind);
  int group_of(const Bulk& bulk, std::size_t cell, CellType type);
  void add_cell(const mesh::Mesh& mesh, const DofMap& dofs, Cell cell);
  const Group& group_of(const Cell& cell) const { return groups_[static_cast<std::size_t>(cell.group)]; }
  struct Share;
  struct Kept;
  /// Of a border cell, those inside its share or those of several shares.
  enum class Nodes { all, own, shared };

  void deal_out(const mesh::Mesh& mesh, const Threads& threads);
  Failed add_each(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                  const Wanted& wanted, const Heat* heat) const;
  Kept room_for_kept(const Wanted& wanted) const;
  static Failed first_failure(std::span<const Share> shares);
  void add_cell(std::size_t i, const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                const Wanted& wanted, const Heat* heat, Share& share, Kept& kept) const;
  element::CellResult evaluate(const Cell& cell, const StepSpan& step, const QuadratureStates& old,
                               QuadratureStates& now, const Wanted& wanted, Scratch& scratch) const;
  element::CellResult evaluate_between(const Cell& cell, const StepSpan& step, const QuadratureStates& old,
                                       QuadratureStates& now, const Wanted& wanted, Scratch& scratch) const;
  void add_answers(std::size_t i, const Wanted& wanted, const Scratch& scratch, Kept& kept) const;
  void add_kept(const Kept& kept, const Wanted& wanted) const;
  PathPart go_along(const Cell& cell, const QuadratureStates& old, const QuadratureStates& now,
                    const element::CellResult& result, const Scratch& scratch, LawPath& path) const;
  struct Motion {
    const Eigen::VectorXd& u;
    const QuadratureStates& states;
    const LawPath& path;
    const Heat* heat;
  };
  double growth_of_cell(std::size_t i, const Motion& motion, double rate, Scratch& scratch) const;
  double growth_of_shape(const Cell& cell, const Eigen::VectorXd& u, const LawPath& path,
                         Scratch& scratch) const;
  double growth_of_tangent(std::size_t cell, const Eigen::VectorXd& u, const QuadratureStates& states,
                           Scratch& scratch) const;
  void gather(const Cell& cell, const Eigen::VectorXd& u, std::vector<double>& values) const;
  bool takes_part(std::size_t node, Nodes nodes) const;
  void scatter(const Cell& cell, const std::vector<double>& values, Nodes which, Eigen::VectorXd& sum) const;
  CellEnd end_of(const Cell& cell, const QuadratureStates& states) const;
  void require_records(const QuadratureStates& states) const;
  void add_tangent(const Cell& cell, const std::vector<double>& tangent, Nodes which,
                   SparseMatrix& matrix) const;

  int components_ = 0;
  std::vector<Group> groups_;
  std::vector<std::int32_t> law_of_group_;
  std::vector<Cell> cells_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<int> dofs_; ///< the first one of each node
  std::vector<std::int32_t>
      places_;              ///< node by node: where the row block of one begins in the columns of another
  std::vector<Rate> rates_; ///< one a cell, when found
  WorkShares shares_;
  std::vector<char> at_shared_node_; ///< beside dofs_; empty with one share
  std::size_t record_count_ = 0;
  std::size_t followed_count_ = 0;
  std::size_t own_states_ = 0; ///< of these cells, in QuadratureStates::values
  bool has_finite_strain_ = false;
  bool has_own_scheme_ = false;
};

} // namespace rubato::domain
