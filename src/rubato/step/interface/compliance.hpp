// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a bulk that keeps its effective matrix A answers to forces on its contact surfaces: A factored once
/// or solved with by iterations, and the surface compliance S = B A⁻¹ Bᵀ, B giving the displacements of the
/// surface by the unknowns.
#pragma once

#include "rubato/constraint/reduction.hpp"
#include "rubato/linalg/split_factor.hpp"
#include "rubato/step/interface/surface_compliance.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rubato::step {

/// Works on interface dofs: displacements of the surfaces that something unknown moves, counted body after
/// body. Without relations each is an unknown of its own. Dofs that relations give are interface dofs too:
/// their rows of B have the coefficients of the relation, and S is that of the unknowns between these rows.
class Compliance {
public:
  static constexpr Eigen::Index usual_largest_whole = SurfaceCompliance::usual_largest_whole;
  static constexpr Eigen::Index block_size = SurfaceCompliance::block_size;

  /// `reduction`: that of the factored matrix; `related_dofs`: dependent dofs of the surfaces, whose unknowns
  /// are all on the factor's surface. A factor without values gets them by `refactor`.
  Compliance(linalg::SplitFactor factor, const constraint::Reduction& reduction,
             std::span<const int> related_dofs = {}, Eigen::Index largest_whole = usual_largest_whole);
  /// The same with any other solver.
  Compliance(std::unique_ptr<linalg::SurfaceSolver> solver, const constraint::Reduction& reduction,
             std::span<const int> related_dofs = {}, Eigen::Index largest_whole = usual_largest_whole);

  /// A is another matrix of the same pattern from here on: SurfaceSolver::refactor, whose errors this throws.
  /// What is known of S is forgotten, but for bodies whose values are the same. Dofs and relations stay.
  /// False when it could not be factored: nothing but another call of this, or what tells of interface dofs,
  /// is allowed then.
  bool refactor(const linalg::SparseMatrix& matrix) { return unknowns_.refactor(matrix); }

  /// A⁻¹ force, an entry an unknown each.
  Eigen::VectorXd solve(const Eigen::VectorXd& force) const { return unknowns_.solver().solve(force); }
  /// Half way through a solve: L⁻¹ force.
  Eigen::VectorXd forward(const Eigen::VectorXd& force) const { return unknowns_.solver().forward(force); }
  /// The surface's displacements, one an interface dof.
  Eigen::VectorXd surface_of(const Eigen::VectorXd& half_way) const;
  /// Adds forces on the surface, one an interface dof, to what `forward` gave.
  void load_surface(const Eigen::VectorXd& force, Eigen::VectorXd& half_way) const;
  /// All unknowns from there.
  Eigen::VectorXd backward(const Eigen::VectorXd& half_way) const {
    return unknowns_.solver().backward(half_way);
  }

  /// Whether each column of S costs a whole solve: it is better used by its products then.
  bool has_dear_columns() const { return unknowns_.solver().has_dear_columns(); }

  /// Of the factor.
  std::size_t factor_entries() const { return unknowns_.solver().factor_bytes() / sizeof(double); }
  /// SurfaceSolver::factor_flops.
  double factor_flops() const { return unknowns_.solver().factor_flops(); }

  /// How many interface dofs there are.
  Eigen::Index size() const { return static_cast<Eigen::Index>(dofs_.size()); }
  const std::vector<int>& dof_of_interface_dof() const { return dofs_; }
  /// −1 for dofs that are held or not on a surface.
  const std::vector<int>& interface_dof_of_dof() const { return interface_dofs_; }
  /// Interface dofs at which one body's end and the next one's begin, 0 first. Bodies that relations tie
  /// count as one.
  const std::vector<int>& body_starts() const {
    return related_ ? related_->starts : unknowns_.solver().body_starts();
  }

  /// Calls take(unknown, coefficient) for each unknown of the factored matrix that moves an interface dof.
  template <class Take> void for_each_unknown(int interface_dof, const Take& take) const {
    const auto& surface = unknowns_.solver().surface();
    if (!related_)
      return take(surface[static_cast<std::size_t>(interface_dof)], 1.0);
    for (Rows::InnerIterator entry(related_->rows, interface_dof); entry; ++entry)
      take(surface[static_cast<std::size_t>(entry.col())], entry.value());
  }

  /// What is asked of one body may be asked of others at the same time.
  const Threads& threads() const { return unknowns_.solver().threads(); }

  /// What asking for S between some of these interface dofs waits for the first time: S of the bodies whose
  /// surfaces are small enough for all of it, several bodies at the same time.
  void compute_whole(std::span<const int> interface_dofs) {
    if (!related_)
      unknowns_.compute_whole(interface_dofs);
  }
  /// S for these interface dofs.
  Eigen::MatrixXd between(std::span<const int> interface_dofs);
  /// The same for interface dofs that all lie on the body of the first, of which there is one; into `s`.
  void within_body(std::span<const int> interface_dofs, Eigen::MatrixXd& s);
  /// Whether forces can be taken together by `between_forces`.
  bool takes_forces_together() const { return unknowns_.takes_forces_together(); }
  /// Fᵀ S F, with F one row an interface dof: of some hundreds of forces on thin bodies this is less work
  /// than S between all dofs that they act on.
  Eigen::MatrixXd between_forces(const linalg::SparseMatrix& forces) const;
  /// d += factor S force, one an interface dof; cheap where most of the force is zero.
  void add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d);
  /// The same with the force given by its entries.
  void add(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d);
  /// Whether compute_whole leaves nothing of S to be computed for forces at the dofs that it was called with.
  bool is_computed_whole() const { return !related_ && unknowns_.is_computed_whole(); }
  /// How far a unit force at an interface dof moves it.
  double own(int interface_dof);

private:
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;
  /// Where relations give dofs of the surface.
  struct Related {
    Rows rows; ///< B: interface dofs by positions
    std::vector<int> starts;
  };
  void relate(const constraint::Reduction& reduction, std::span<const int> related_dofs);
  std::vector<std::size_t> bodies_of(const constraint::Reduction& reduction,
                                     std::span<const int> related_dofs) const;
  void number(const constraint::Reduction& reduction);

  SurfaceCompliance unknowns_;
  std::vector<int> dofs_;
  std::vector<int> interface_dofs_;
  std::optional<Related> related_;
};

} // namespace rubato::step
