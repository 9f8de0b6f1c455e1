// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/equilibrium.hpp"

#include <algorithm>
#include <limits>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Rounding errors that a row of K u may gather, in units of the last digit of its largest term.
constexpr double rounding_steps = 16;

VectorXd multiply(const model::SparseMatrix& matrix, const VectorXd& v) {
  return matrix.nonZeros() > 0 ? VectorXd(matrix * v) : VectorXd::Zero(v.size());
}

VectorXd history_forces(const Model& model, const time::Scheme& scheme, const State& committed) {
  VectorXd history = scheme.forces.before * committed.unbalance;
  if (scheme.inertia.before != 0)
    history += scheme.inertia.before * multiply(model.mass, committed.motion.a);
  if (scheme.damping.before != 0)
    history += scheme.damping.before * multiply(model.damping, committed.motion.v);
  return history;
}

} // namespace

ContactForce::ContactForce(Index dofs)
    : all(VectorXd::Zero(dofs)), nodal(VectorXd::Zero(dofs)), forgotten(VectorXd::Zero(dofs)) {}

Equilibrium::Equilibrium(const Model& model, const time::Scheme& scheme, const EffectiveSystem& system,
                         const State& committed, double t)
    : model_(model), scheme_(scheme), system_(system), t_(t), external_(model::external_force(model, t)),
      history_(history_forces(model, scheme, committed)) {}

void Equilibrium::evaluate(const time::Motion& motion, const ContactForce& contact) {
  forces_.internal.noalias() = model_.stiffness * motion.u;
  forces_.inertia = scheme_.dynamic ? multiply(model_.mass, motion.a) : VectorXd::Zero(motion.u.size());
  inertia_ = scheme_.inertia.now * forces_.inertia;
  if (scheme_.damping.now != 0 && model_.damping.nonZeros() > 0) {
    forces_.damping = model_.damping * motion.v;
    inertia_ += scheme_.damping.now * forces_.damping;
  }
  unbalance_ = forces_.internal + contact.all - external_;
  full_residual_ = inertia_ + scheme_.forces.now * unbalance_ + history_;
  residual_ = full_residual_(model_.free_dofs);
}

void Equilibrium::measure(const time::Motion& motion, const ContactForce& contact, StepReport& report) {
  VectorXd reference = scheme_.forces.now * (external_ - contact.nodal) - inertia_ - history_;
  for (const auto& constraint : model_.constraints)
    reference[constraint.dof] -= full_residual_[constraint.dof];
  scale_ = reference.lpNorm<Eigen::Infinity>();
  forces_.momentum = scheme_.dynamic ? multiply(model_.mass, motion.v) : VectorXd::Zero(motion.u.size());
  scale_ = std::max(scale_, forces_.momentum.lpNorm<Eigen::Infinity>() * system_.coefficients.acceleration *
                                system_.step);
  Index worst = 0;
  const double largest = residual_.size() > 0 ? residual_.cwiseAbs().maxCoeff(&worst) : 0.0;
  // Where nothing but rounding is left there is no force to measure it by: a body that moves without
  // strain.
  const double rounding = rounding_steps * std::numeric_limits<double>::epsilon() *
                          system_.diagonal.lpNorm<Eigen::Infinity>() * motion.u.lpNorm<Eigen::Infinity>();
  report.residual = largest == 0 || std::max(largest, scale_) <= rounding ? 0 : largest / scale_;
  report.worst_node =
      residual_.size() > 0 ? model_.node_of(model_.free_dofs[static_cast<std::size_t>(worst)]) : -1;
}

void Equilibrium::finish(const ContactForce& contact, State& trial) const {
  trial.t = t_;
  trial.force_scale = scale_;
  trial.unbalance = unbalance_ - contact.forgotten;
  trial.contact_force = contact.all;
  trial.forces = forces_;
  trial.forces.external = external_;
  trial.reaction = VectorXd::Zero(unbalance_.size());
  for (const auto& constraint : model_.constraints)
    trial.reaction[constraint.dof] = full_residual_[constraint.dof];
}

} // namespace rubato::step
