// SPDX-License-Identifier: LGPL-3.0-or-later
// Accelerations, reactions, works and energies of explicit motion.
#include "rubato/domain/heat.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::step {

using Eigen::Index;
using Eigen::VectorXd;

/// [U_held] − {u}·[f]
void ExplicitMotion::enter_heat(double from, double to) {
  const auto* heat = model_->domain.heat();
  if (heat == nullptr)
    return;
  VectorXd now = heat->force(to);
  const VectorXd mean = u_ - h_ / 2 * v_;
  energy_.heat += heat->held_energy(to) - heat->held_energy(from) - mean.dot(now - heat_force_);
  heat_force_.swap(now);
}

/// What half of the contact forces of now do between two instants, on the bodies and by obstacles that move.
void ExplicitMotion::enter_contact(double from, double to) {
  if (!counts())
    return;
  double power = 0;
  for (const int dof : surface_)
    power += contact_force_[dof] * v_[dof];
  const double given = work_of_obstacles(from, to);
  energy_.impact += h_ / 2 * power + given;
  energy_.support_work += given;
}

double ExplicitMotion::work_of_obstacles(double from, double to) const {
  double sum = 0;
  for (std::size_t z = 0; z < contact_.size(); ++z)
    if (const auto& obstacle = model_->zones[touching_[z]].obstacle; obstacle && obstacle->moves())
      sum += contact_[z].work_of_obstacle({&model_->mesh, &model_->dofs, &u_, &u_, to, from}, v_, h_) / 2;
  return sum;
}

/// Entered by the trapezoidal rule.
void ExplicitMotion::enter_supports() {
  auto before = std::pair(supports_, relations_);
  find_reactions();
  for (std::size_t i = 0; i < supports_.size(); ++i)
    if (const int dof = supports_[i].prescribed->dof; owns(dof))
      energy_.support_work += (before.first[i].reaction + supports_[i].reaction) / 2 * h_ * v_[dof];
  for (std::size_t i = 0; i < relations_.size(); ++i)
    if (relations_[i].moves)
      energy_.support_work += (before.second[i].reaction + relations_[i].reaction) / 2 * relations_[i].change;
}

/// r + M a of what moves.
void ExplicitMotion::find_reactions() {
  if (!(h_ > 0))
    return;
  if (relations_.empty() && !mass_.has_attached()) {
    for (auto& support : supports_) {
      const int dof = support.prescribed->dof;
      support.reaction = unbalance_[dof] + model_->lumped_mass[dof] * imposed_acceleration(support);
    }
    return;
  }
  if (supports_.empty() && std::ranges::none_of(relations_, &Relation::moves))
    return;
  const VectorXd inertia = mass_.times(acceleration());
  for (auto& support : supports_)
    support.reaction = unbalance_[support.prescribed->dof] + inertia[support.prescribed->dof];
  for (auto& relation : relations_)
    relation.reaction = unbalance_[relation.dependent->dof] + inertia[relation.dependent->dof];
}

double ExplicitMotion::imposed_acceleration(const MovingSupport& support) const {
  const int dof = support.prescribed->dof;
  return ((reduction_->displacement(*support.prescribed, t_ + h_) - u_[dof]) / h_ - v_[dof]) / h_;
}

/// Of the part of a dependent dof that no unknown gives.
double ExplicitMotion::given_acceleration(const Relation& relation) const {
  double velocity = v_[relation.dependent->dof];
  for (const auto& term : relation.dependent->of)
    velocity -= term.coefficient * v_[term.dof];
  return ((reduction_->given_part(*relation.dependent, t_ + h_) - relation.given) / h_ - velocity) / h_;
}

/// g̈: what supports and relations give.
VectorXd ExplicitMotion::given_accelerations() const {
  VectorXd a = VectorXd::Zero(u_.size());
  if (!(h_ > 0))
    return a;
  for (const auto& support : supports_)
    a[support.prescribed->dof] = imposed_acceleration(support);
  for (const auto& relation : relations_)
    if (relation.moves)
      a[relation.dependent->dof] = given_acceleration(relation);
  return a;
}

/// r + M g̈
VectorXd ExplicitMotion::related_force() const {
  if (supports_.empty() && std::ranges::none_of(relations_, &Relation::moves))
    return unbalance_;
  return unbalance_ + mass_.times(given_accelerations());
}

/// T q̈
VectorXd ExplicitMotion::unknown_acceleration() const {
  VectorXd a = -uncoupled_.cwiseProduct(unbalance_);
  if (mass_.couples())
    mass_.respond(-related_force(), a);
  return a;
}

VectorXd ExplicitMotion::acceleration() const {
  return unknown_acceleration() + given_accelerations();
}

EnergyLedger ExplicitMotion::energy() const {
  auto ledger = energy_;
  ledger.kinetic = kinetic_energy();
  ledger.hourglass = model_->domain.hourglass_energy(u_);
  ledger.strain = strain_energy() - ledger.hourglass;
  if (const auto* heat = model_->domain.heat())
    ledger.held_heat = heat->held_energy(t_);
  for (const auto& zone : contact_)
    if (counts()) {
      ledger.contact += zone.stored();
      ledger.friction += zone.dissipated();
    }
  ledger.impact -= ledger.contact + ledger.friction;
  return summed(ledger);
}

double ExplicitMotion::kinetic_energy() const {
  const VectorXd after = v_ + h_ * acceleration();
  return energy_.kinetic + 0.5 * v_.dot(counted_mass_.cwiseProduct(after)) +
         0.5 * mass_.attached_product(v_, after);
}

/// Of the present states, which have no records: that of nonlinear cells is the path's, hourglasses with it.
double ExplicitMotion::strain_energy() const {
  const auto& domain = model_->domain;
  if (!domain.is_linear())
    return domain.energy(u_, path_.forces, t_, bulk_points_) + path_.stored;
  VectorXd internal;
  domain::QuadratureStates unchanged;
  domain.evaluate({u_, u_, t_, t_}, bulk_points_, unchanged, {.forces = &internal});
  return domain.energy(u_, internal, t_, bulk_points_);
}

} // namespace rubato::step
