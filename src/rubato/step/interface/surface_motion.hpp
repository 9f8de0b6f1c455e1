// SPDX-License-Identifier: LGPL-3.0-or-later
/// How the contact surfaces of a bulk with a factored matrix A move under contact forces, from a base:
/// d_s = d_free − f₁ S f, S = B A⁻¹ Bᵀ, and d of the whole bulk where that is asked for. A is solved with in
/// halves, once a base (linalg/split_factor.hpp).
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/common/equilibrium.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

namespace rubato::step {

class SurfaceMotion {
public:
  /// Everything must outlive this.
  SurfaceMotion(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system);

  /// Takes a motion as the base that everything is counted from.
  void start_from(const time::Motion& base, Equilibrium& equilibrium);
  /// The same with a residual that is known, without contact.
  void start_from(const time::Motion& base, const Eigen::VectorXd& residual);
  /// Takes a motion as the base together with the contact forces there, whose residual this is: what moves
  /// from it is their change, beside which rounding of whole forces on weak springs is large.
  void start_from(const time::Motion& base, const Eigen::VectorXd& residual, const Eigen::VectorXd& force);
  /// What the base does not carry of forces on the surface.
  Eigen::VectorXd beyond_carried(const Eigen::VectorXd& force) const;
  /// d_s as forces on the surface push it.
  Eigen::VectorXd moved_by(const Eigen::VectorXd& force) const;
  /// As the forces applied push it.
  void move(State& trial);
  /// To where a motion has the surfaces.
  void go_to(const time::Motion& motion, State& trial);
  /// Takes back all but `part` of the move from `before`; the forces stay those of the whole move.
  void shorten(const Eigen::VectorXd& before, double part, State& trial);
  void place(State& trial) const { place(moved, trial); }
  /// To where d_s would have the surfaces.
  void place(const Eigen::VectorXd& d_s, State& trial) const;
  /// The whole motion that belongs to the forces on the surface.
  void move_bulk(State& trial) const;

  time::Motion base;
  Eigen::VectorXd free;    ///< d_free on the surface
  Eigen::VectorXd moved;   ///< d_s
  Eigen::VectorXd applied; ///< contact force on the surface that `moved` belongs to
  bool consistent = true;  ///< whether it does: not where a move was made shorter

private:
  void take_base(const time::Motion& motion, const Eigen::VectorXd& residual);

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  Eigen::VectorXd half_way_; ///< L⁻¹(−R₀): the free motion, solved down to the surface
  Eigen::VectorXd carried_;  ///< contact force on the surface that the base has; none where it has none
};

} // namespace rubato::step
