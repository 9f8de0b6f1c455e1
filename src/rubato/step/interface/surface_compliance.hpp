// SPDX-License-Identifier: LGPL-3.0-or-later
/// The compliance S = B A⁻¹ Bᵀ of the surface unknowns of a matrix A that is solved with, B picking them. S
/// of a body is computed when first asked for: whole, or of large surfaces some columns or blocks only, as
/// few contact points are ever active. Only this folder's compliance.hpp includes this.
#pragma once

#include "rubato/linalg/surface_solver.hpp"
#include "rubato/step/interface/block_compliance.hpp"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rubato::step {

/// A force on one of the surface's unknowns.
struct ForceAt {
  int interface_dof = 0;
  double force = 0;
};

/// Surface unknowns are counted by their positions in the solver: SurfaceSolver::surface().
class SurfaceCompliance {
public:
  /// Surfaces of bodies up to this size have S computed whole: three seconds at most.
  static constexpr Eigen::Index usual_largest_whole = 5000;
  /// Neighbouring columns of larger surfaces that are always computed together: enough for matrix–matrix
  /// products, few that are never asked for. In space they belong to a patch of 4 by 4 nodes. The last digits
  /// of a column depend on which columns are computed with it; as these are always the same, they don't
  /// depend on what was asked for before, and a resumed run has the same ones.
  static constexpr Eigen::Index block_size = 48;
  /// Of solvers whose columns cost a solve each: where so many of them would be read for one force, that one
  /// is solved with instead.
  static constexpr Eigen::Index most_dear_columns = 600;

  /// S of surfaces that the factor eliminates within their bodies is whole where it says so, else by blocks.
  /// Of a solver whose columns cost a solve each all are computed one by one.
  explicit SurfaceCompliance(std::unique_ptr<linalg::SurfaceSolver> solver,
                             Eigen::Index largest_whole = usual_largest_whole);

  /// SurfaceSolver::refactor; S is forgotten of bodies whose values are others or lost.
  bool refactor(const linalg::SparseMatrix& matrix);

  const linalg::SurfaceSolver& solver() const { return *solver_; }
  Eigen::Index size() const { return static_cast<Eigen::Index>(solver_->surface().size()); }

  /// S for these positions.
  Eigen::MatrixXd between(std::span<const int> positions);
  /// The same for positions that all lie on the body of the first, of which there is one; into `s`.
  void within_body(std::span<const int> positions, Eigen::MatrixXd& s);
  /// Whether forces can be taken together by `between_forces`.
  bool takes_forces_together() const;
  /// Fᵀ S F, with F one row a position: of some hundreds of forces on thin bodies this is less work
  /// than S between all dofs that they act on.
  Eigen::MatrixXd between_forces(const linalg::SparseMatrix& forces) const;
  /// d += factor S force, one a position each; cheap where most of the force is zero.
  void add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d);
  /// The same with the force given by its entries.
  void add(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d);

  /// S of the bodies of these positions, where it is computed whole and has not been yet: several bodies at
  /// the same time.
  void compute_whole(std::span<const int> positions);

  /// Whether that is how S of all bodies is computed.
  bool is_computed_whole() const;

  /// How far a unit force at a position moves it.
  double own(int position) {
    const int body = body_of(position);
    const int within = position - first_of_body(body);
    return in_blocks(body) ? blocks_[static_cast<std::size_t>(body)]->own(within) : column(position)[within];
  }

private:
  void add_of_body(std::size_t body, double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d);
  int body_of(int position) const { return body_of_[static_cast<std::size_t>(position)]; }
  int first_of_body(int body) const { return solver_->body_starts()[static_cast<std::size_t>(body)]; }
  bool in_blocks(int body) const {
    return has_blocks_ && blocks_[static_cast<std::size_t>(body)].has_value();
  }
  const double* column(int position);
  const Eigen::MatrixXd& whole(std::size_t body);
  bool is_solved_with(std::size_t body, Eigen::Index forces) const;
  void add_gathered(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d);
  bool is_computed_whole(int body) const {
    return solver_->surface_within(static_cast<std::size_t>(body)) != nullptr
               ? !in_blocks(body)
               : first_of_body(body + 1) - first_of_body(body) <= largest_whole_;
  }
  void compute(int body, Eigen::Index place);
  void forget(std::size_t body);

  std::unique_ptr<linalg::SurfaceSolver> solver_;
  Eigen::Index largest_whole_;
  std::vector<int> body_of_;                           ///< by position
  std::vector<Eigen::MatrixXd> s_;                     ///< by body: empty until used
  std::vector<char> known_;                            ///< by position: whether its column is computed
  std::vector<std::optional<BlockCompliance>> blocks_; ///< by body, where S is not formed whole
  std::vector<std::size_t> renewals_;                  ///< by body, of the factor that S is of
  bool has_blocks_ = false;
};

} // namespace rubato::step
