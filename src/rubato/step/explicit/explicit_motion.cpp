// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/explicit/explicit_motion.hpp"

#include "rubato/core/function.hpp"
#include "rubato/linalg/lanczos.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Steps whose lengths differ by less than this part are the same but for the rounding of instants.
constexpr double rounding = 1e-9;

/// How many times stiffer a spring counts that only pushes.
constexpr double impact = 4;

double factor_at(const std::optional<Function>& function, double t) {
  return function ? value_at(*function, t) : 1.0;
}

VectorXd inverse_masses(const Model& model, const constraint::Reduction& reduction) {
  VectorXd inverse = VectorXd::Zero(model.lumped_mass.size());
  for (const int dof : reduction.free_dofs()) {
    if (!(model.lumped_mass[dof] > 0))
      throw InputError("node " + model::node_label(model.mesh, model.node_of(dof)) +
                       " has no mass: every cell of a dynamic run needs a positive density");
    inverse[dof] = 1 / model.lumped_mass[dof];
  }
  return inverse;
}

/// v −= h M⁻¹ r, u += h v in one sweep: vectors cost memory traffic, too.
void central_difference_update(double h, const VectorXd& inverse_mass, const VectorXd& residual_force,
                               VectorXd& velocity, VectorXd& displacement) {
  const double* m = inverse_mass.data();
  const double* r = residual_force.data();
  double* v = velocity.data();
  double* u = displacement.data();
  for (Index i = 0; i < velocity.size(); ++i) {
    v[i] -= h * m[i] * r[i];
    u[i] += h * v[i];
  }
}

std::vector<int> surface_dofs(const Model& model) {
  std::vector<int> dofs;
  for (const auto& zone : model.zones)
    for (const auto* surface : {&zone.master, &zone.slave})
      for (const auto node : surface->nodes)
        for (int i = 0; i < model.dofs.components; ++i)
          dofs.push_back(model.dofs.dof(node, i));
  std::ranges::sort(dofs);
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  return dofs;
}

} // namespace

double Spectrum::stable_step() const {
  return 4 / (damping + std::sqrt(damping * damping + 4 * (stiffness + impact * contact)));
}

ExplicitMotion::ExplicitMotion(const Model& model)
    : model_(&model), reduction_(std::make_shared<const constraint::Reduction>(model.reduction)),
      inverse_mass_(inverse_masses(model, model.reduction)), surface_(surface_dofs(model)),
      t_(model.study.time.begin), u_(model.initial.displacement), v_(model.initial.velocity),
      bulk_points_(model.domain.initial_states()), unbalance_(VectorXd::Zero(inverse_mass_.size())),
      contact_force_(unbalance_) {
  if (model.damping.nonZeros() > 0) {
    damping_.emplace(model.damping, model.dofs.components);
    damping_force_ = unbalance_;
  }
  find_spectrum();
  for (const auto& zone : model.zones)
    contact_.emplace_back(zone, model.dofs,
                          contact::penalty_stiffness(zone, model.dofs, inverse_mass_, spectrum_.stiffness));
  reduction_->impose(t_, u_);
  collect_supports();
  collect_loads();
  if (const auto* heat = model.domain.heat())
    heat_force_ = heat->force(t_);
  deform();
  find_forces();
  energy_ = {.back_stress = model.domain.back_stress_energy(bulk_points_), .impact = energy().contact};
  energy_.start = energy().stored();
}

Spectrum ExplicitMotion::spectrum() const {
  auto spectrum = spectrum_;
  spectrum.contact = contact::largest_eigenvalue(contact_, inverse_mass_);
  return spectrum;
}

void ExplicitMotion::find_spectrum() {
  spectrum_.stiffness = model_->domain.largest_eigenvalue(inverse_mass_);
  if (damping_)
    spectrum_.damping = linalg::largest_eigenvalue(*damping_, inverse_mass_);
}

void ExplicitMotion::collect_supports() {
  supports_.clear();
  for (const auto& prescribed : reduction_->prescribed())
    if (reduction_->moves(prescribed))
      supports_.push_back({&prescribed});
}

/// The velocity now stays what it is, so that half a step before moves with the acceleration. So does the
/// kinetic energy there, which the balance must not take for a gain.
void ExplicitMotion::take_supports(const constraint::Reduction& reduction) {
  const double kinetic = energy().kinetic;
  v_ += h_ / 2 * acceleration();
  reduction_ = std::make_shared<const constraint::Reduction>(reduction);
  inverse_mass_ = inverse_masses(*model_, reduction);
  find_spectrum();
  collect_supports();
  v_ -= h_ / 2 * acceleration();
  energy_.kinetic += kinetic - energy().kinetic;
  if (h_ > 0)
    for (auto& support : supports_)
      support.reaction = reaction_of(support);
}

void ExplicitMotion::collect_loads() {
  for (const auto& force : model_->forces) {
    Load load{{}, {}, &force.function, 0, factor_at(force.function, t_)};
    for (Index dof = 0; dof < force.pattern.size(); ++dof)
      if (force.pattern[dof] != 0) {
        load.dofs.push_back(static_cast<int>(dof));
        load.values.push_back(force.pattern[dof]);
        load.displacement += force.pattern[dof] * u_[dof];
      }
    loads_.push_back(std::move(load));
  }
}

void ExplicitMotion::advance(double end, int steps) {
  const double begin = t_;
  set_step((end - begin) / steps);
  for (int i = 1; i < steps; ++i)
    step(begin + i * h_);
  step(end);
}

/// The velocity half a step before t moves with the length of the step. So does the kinetic energy there,
/// which the balance must not take for a gain.
void ExplicitMotion::set_step(double step) {
  if (std::abs(step - h_) <= rounding * h_)
    return;
  const double kinetic = energy().kinetic;
  v_ += (h_ - step) / 2 * acceleration();
  h_ = step;
  for (auto& support : supports_) {
    const int dof = support.prescribed->dof;
    v_[dof] = (u_[dof] - reduction_->displacement(*support.prescribed, t_ - h_)) / h_;
  }
  energy_.kinetic += kinetic - energy().kinetic;
  for (auto& support : supports_)
    support.reaction = reaction_of(support);
}

void ExplicitMotion::step(double end) {
  for (const auto& support : supports_) {
    const int dof = support.prescribed->dof;
    v_[dof] = (reduction_->displacement(*support.prescribed, end) - u_[dof]) / h_;
  }
  central_difference_update(h_, inverse_mass_, unbalance_, v_, u_);
  const double begin = std::exchange(t_, end);
  ++steps_;
  const double damping_power = damping_ ? damping_force_.dot(v_) : 0;
  if (const auto springs = model_->domain.law_springs(); !springs.empty())
    energy_.numerical += domain::missed_between(springs, u_ - h_ * v_, u_);
  enter_heat(begin, end);
  enter_contact(begin, end);
  find_forces();
  enter_contact(begin, end);
  if (damping_)
    energy_.damping += h_ / 2 * (damping_power + damping_force_.dot(v_));
  for (auto& support : supports_) {
    const double reaction = reaction_of(support);
    energy_.support_work += (support.reaction + reaction) / 2 * h_ * v_[support.prescribed->dof];
    support.reaction = reaction;
  }
}

/// The bodies come to the initial displacements from their undeformed shape at once.
void ExplicitMotion::deform() {
  model_->domain.evaluate({u_, u_, t_, t_}, bulk_points_, bulk_points_next_, {.records = true});
  std::swap(bulk_points_, bulk_points_next_);
}

/// The domain sees the end of a step only: to keep its start as well would cost memory traffic.
void ExplicitMotion::find_forces() {
  const auto& domain = model_->domain;
  domain.evaluate({u_, u_, t_ - h_, t_}, bulk_points_, bulk_points_next_,
                  {.forces = &unbalance_, .records = true});
  enter(domain.balance(bulk_points_, bulk_points_next_), energy_);
  std::swap(bulk_points_, bulk_points_next_);
  if (damping_) {
    damping_->multiply(v_, damping_force_);
    domain::add_beyond_matrix(model_->dampers, v_, damping_force_);
    unbalance_ += damping_force_;
  }
  for (const int dof : surface_)
    contact_force_[dof] = 0;
  const contact::Configuration configuration{&model_->mesh, &model_->dofs, &u_, &u_, t_, t_ - h_};
  for (auto& zone : contact_)
    zone.advance(configuration, v_, h_, contact_force_);
  for (const int dof : surface_)
    unbalance_[dof] += contact_force_[dof];
  for (auto& load : loads_)
    apply(load);
}

/// Adds a load to the residual force, and its work since the last instant.
void ExplicitMotion::apply(Load& load) {
  const double factor = factor_at(*load.function, t_);
  double displacement = 0;
  for (std::size_t i = 0; i < load.dofs.size(); ++i) {
    unbalance_[load.dofs[i]] -= factor * load.values[i];
    displacement += load.values[i] * u_[load.dofs[i]];
  }
  energy_.external_work += (load.factor + factor) / 2 * (displacement - load.displacement);
  load.factor = factor;
  load.displacement = displacement;
}

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
    if (const auto& obstacle = model_->zones[z].obstacle; obstacle && obstacle->moves())
      sum += obstacle->displacement(from, to).dot(contact_[z].push()) / 2;
  return sum;
}

double ExplicitMotion::reaction_of(const MovingSupport& support) const {
  const int dof = support.prescribed->dof;
  return unbalance_[dof] + model_->lumped_mass[dof] * imposed_acceleration(support);
}

double ExplicitMotion::imposed_acceleration(const MovingSupport& support) const {
  const int dof = support.prescribed->dof;
  return ((reduction_->displacement(*support.prescribed, t_ + h_) - u_[dof]) / h_ - v_[dof]) / h_;
}

VectorXd ExplicitMotion::acceleration() const {
  VectorXd a = -inverse_mass_.cwiseProduct(unbalance_);
  if (h_ > 0)
    for (const auto& support : supports_)
      a[support.prescribed->dof] = imposed_acceleration(support);
  return a;
}

EnergyLedger ExplicitMotion::energy() const {
  auto ledger = energy_;
  const VectorXd after = v_ + h_ * acceleration();
  ledger.kinetic += 0.5 * v_.dot(model_->lumped_mass.cwiseProduct(after));
  ledger.strain = strain_energy();
  if (const auto* heat = model_->domain.heat())
    ledger.held_heat = heat->held_energy(t_);
  for (const auto& zone : contact_) {
    ledger.contact += zone.stored();
    ledger.friction += zone.dissipated();
  }
  ledger.impact -= ledger.contact + ledger.friction;
  return ledger;
}

double ExplicitMotion::strain_energy() const {
  VectorXd internal;
  domain::QuadratureStates unchanged;
  model_->domain.evaluate({u_, u_, t_, t_}, bulk_points_, unchanged, {.forces = &internal});
  return model_->domain.energy(u_, internal, t_, bulk_points_);
}

ExplicitMotion::Memory ExplicitMotion::memory() const {
  Memory memory{t_, h_, steps_, u_, v_,      unbalance_,  contact_force_, damping_force_,
                {}, {}, {},     {}, energy_, bulk_points_};
  for (const auto& load : loads_) {
    memory.load_factors.push_back(load.factor);
    memory.load_displacements.push_back(load.displacement);
  }
  for (const auto& support : supports_)
    memory.reactions.push_back(support.reaction);
  for (const auto& zone : contact_)
    memory.zones.push_back(zone.memory());
  return memory;
}

void ExplicitMotion::restore(const Memory& memory) {
  t_ = memory.t;
  h_ = memory.step;
  steps_ = memory.steps;
  u_ = memory.u;
  v_ = memory.v;
  unbalance_ = memory.residual_force;
  contact_force_ = memory.contact_force;
  damping_force_ = memory.damping_force;
  energy_ = memory.energy;
  if (const auto* heat = model_->domain.heat())
    heat_force_ = heat->force(t_);
  bulk_points_ = memory.bulk_points;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    loads_[i].factor = memory.load_factors.at(i);
    loads_[i].displacement = memory.load_displacements.at(i);
  }
  for (std::size_t i = 0; i < supports_.size(); ++i)
    supports_[i].reaction = memory.reactions.at(i);
  for (std::size_t z = 0; z < contact_.size(); ++z)
    contact_[z].restore(memory.zones.at(z), {&model_->mesh, &model_->dofs, &u_, &u_, t_, t_});
}

State ExplicitMotion::state() const {
  State state;
  state.t = t_;
  const VectorXd a = acceleration();
  state.motion = {u_, v_ + h_ / 2 * a, a};
  state.bulk_points = bulk_points_;
  state.residual_force = unbalance_;
  if (damping_)
    state.residual_force -= damping_force_;
  state.contact_force = contact_force_;
  state.reaction = reduction_->reaction(unbalance_ + model_->lumped_mass.cwiseProduct(a));
  for (const auto& zone : contact_)
    state.zones.push_back(zone.state());
  return state;
}

} // namespace rubato::step
