// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/surface_motion.hpp"

#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/model.hpp"

#include <utility>

namespace rubato::step {

using Eigen::Index;
using Eigen::VectorXd;

SurfaceMotion::SurfaceMotion(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system)
    : model_(model), scheme_(scheme), system_(system) {}

void SurfaceMotion::start_from(const time::Motion& motion, Equilibrium& equilibrium) {
  equilibrium.evaluate(motion, ContactForce(motion.u.size()));
  start_from(motion, equilibrium.residual());
}

void SurfaceMotion::start_from(const time::Motion& motion, const VectorXd& residual) {
  take_base(motion, system_.slopes.adjusted(residual, motion));
  carried_.resize(0);
}

void SurfaceMotion::start_from(const time::Motion& motion, const VectorXd& residual, const VectorXd& force) {
  take_base(motion, system_.slopes.adjusted(residual, motion));
  carried_ = applied = force;
}

VectorXd SurfaceMotion::beyond_carried(const VectorXd& force) const {
  return carried_.size() == 0 ? force : VectorXd(force - carried_);
}

void SurfaceMotion::take_base(const time::Motion& motion, const VectorXd& residual) {
  base = motion;
  half_way_ = system_.compliance->forward(-residual);
  free = system_.compliance->surface_of(half_way_);
  moved = applied = VectorXd::Zero(free.size());
  consistent = true;
}

VectorXd SurfaceMotion::moved_by(const VectorXd& force) const {
  VectorXd there = free;
  system_.compliance->add(-scheme_.contact_weight(), beyond_carried(force), there);
  return linalg::of_first(std::move(there), model_.sharing());
}

void SurfaceMotion::move(State& trial) {
  moved = moved_by(applied);
  place(trial);
}

void SurfaceMotion::go_to(const time::Motion& motion, State& trial) {
  const auto& dofs = system_.compliance->dof_of_interface_dof();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    moved[static_cast<Index>(i)] = motion.u[dofs[i]] - base.u[dofs[i]];
  place(trial);
}

void SurfaceMotion::shorten(const VectorXd& before, double part, State& trial) {
  consistent = part == 1;
  if (consistent)
    return;
  moved = before + part * (moved - before);
  place(trial);
}

void SurfaceMotion::place(const VectorXd& d_s, State& trial) const {
  const auto& dofs = system_.compliance->dof_of_interface_dof();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    trial.motion.u[dofs[i]] = base.u[dofs[i]] + d_s[static_cast<Index>(i)];
}

void SurfaceMotion::move_bulk(State& trial) const {
  VectorXd half_way = half_way_;
  system_.compliance->load_surface(-scheme_.contact_weight() * beyond_carried(applied), half_way);
  const VectorXd d = model_.reduction.scatter(system_.compliance->backward(half_way));
  trial.motion = base;
  time::correct(system_.coefficients, d, trial.motion);
}

} // namespace rubato::step
