// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/equilibrium.hpp"

#include "rubato/core/tolerances.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/linalg/sparse_products.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/mesh/rounding.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Of the largest contact force: what loads and reactions are at least held for in the residual's scale.
constexpr double least_scale = 1e-4;

/// Displacements by which rounding may be told in a step to t [length]. Iterations of bodies that flow may
/// have no end, and run to where any force would count as rounding. Linear bodies do not.
double reach_of(const Model& model, const State& committed, double t) {
  if (model.domain.is_linear())
    return std::numeric_limits<double>::infinity();
  const auto& [u, v, a] = committed.motion;
  return std::max({mesh::diagonal(model.mesh), model.reduction.imposed(t).lpNorm<Eigen::Infinity>(),
                   u.lpNorm<Eigen::Infinity>() + (t - committed.t) * v.lpNorm<Eigen::Infinity>()});
}

/// sum += factor |matrix| values
void add_magnitudes(double factor, const model::SparseMatrix& matrix, const VectorXd& values, VectorXd& sum) {
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (model::SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      sum[entry.row()] += factor * std::abs(entry.value()) * values[entry.col()];
}

VectorXd history_forces(const time::Scheme& scheme, const State& committed) {
  VectorXd history = scheme.forces.before * committed.residual_force;
  if (scheme.inertia.before != 0)
    history += scheme.inertia.before * committed.bulk.inertia;
  if (scheme.damping.before != 0 && committed.bulk.viscous.size() > 0)
    history += scheme.damping.before * committed.bulk.viscous;
  return history;
}

/// Adds the springs of a zone's points to the dofs of their nodes, and the largest to those of the master.
template <class SpringOf>
void add_springs(const Model& model, const contact::Zone& zone, const SpringOf& spring_of,
                 VectorXd& stiffness) {
  const auto add = [&](mesh::NodeIndex node, double spring) {
    for (int i = 0; i < model.dofs.components; ++i)
      stiffness[model.dofs.dof(node, i)] += spring;
  };
  double largest = 0;
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const auto& point = zone.points[i];
    const double spring = spring_of(i);
    largest = std::max(largest, spring);
    for (std::size_t n = 0; n < point.nodes.size(); ++n)
      add(point.nodes[n], std::abs(point.shape[n]) * spring);
  }
  for (const auto node : zone.master.nodes)
    add(node, largest);
}

} // namespace

ContactStiffness contact_stiffness(const Model& model, const EffectiveSystem& system,
                                   const std::vector<std::vector<double>>& springs,
                                   const std::vector<std::vector<double>>& friction) {
  ContactStiffness stiffness{system.diagonal, VectorXd::Zero(system.diagonal.size())};
  for (std::size_t z = 0; z < model.zones.size(); ++z) {
    const auto& zone = model.zones[z];
    add_springs(
        model, zone, [&](std::size_t i) { return springs[z][i]; }, stiffness.by_position);
    add_springs(
        model, zone, [&](std::size_t i) { return friction[z][i]; }, stiffness.by_displacement);
  }
  return stiffness;
}

ContactForce::ContactForce(Index dofs)
    : all(VectorXd::Zero(dofs)), nodal(VectorXd::Zero(dofs)), forgotten(VectorXd::Zero(dofs)) {}

ContactForce ContactForce::after(const ContactForce& other, double part) const {
  ContactForce mixed = other;
  mixed.add(part, *this, other);
  return mixed;
}

void ContactForce::add(double share, const ContactForce& to, const ContactForce& from) {
  all += share * (to.all - from.all);
  nodal += share * (to.nodal - from.nodal);
  forgotten += share * (to.forgotten - from.forgotten);
}

Equilibrium::Equilibrium(const Model& model, const time::Scheme& scheme, const EffectiveSystem& system,
                         const State& committed, double t)
    : model_(model), scheme_(scheme), system_(system), t_(t), committed_(committed),
      predicted_acceleration_(time::predicted_acceleration(scheme, system.step, committed.motion)),
      predicted_bulk_(time::predict(
          scheme, system.step, {committed.bulk.internal, committed.bulk.momentum, committed.bulk.inertia})),
      dead_(model::external_force(model, t, committed.load_factor)), external_(dead_),
      load_factor_(committed.load_factor), reach_(reach_of(model, committed, t)),
      history_(history_forces(scheme, committed)) {
  if (const auto* heat = model.domain.heat())
    heat_ = heat->largest_force(t);
}

/// The prediction is a combination of what is known; from there on one evaluation of the domain and one
/// product with M do.
void Equilibrium::take_motion(const time::Motion& motion) {
  has_forces_at(motion.u);
  take_loads(motion.u);
  take_inertia(motion);
}

bool Equilibrium::has_forces_at(const VectorXd& u) {
  if (evaluated_at_ && *evaluated_at_ == u)
    return !failed_;
  auto span = span_to(u);
  if (scheme_.remembers_internal())
    span.forces0 = &predicted_bulk_.u;
  failed_ = model_.domain.evaluate(span, committed_.bulk_points, bulk_points_, {.forces = &bulk_.internal});
  if (!model_.domain.is_linear())
    evaluated_at_ = u;
  return !failed_;
}

domain::StepSpan Equilibrium::span_to(const VectorXd& u) const {
  return {committed_.motion.u, u, committed_.t, t_, nullptr, forces_of(scheme_)};
}

/// Those that follow their faces are where the bodies are.
void Equilibrium::take_loads(const VectorXd& u) {
  if (model_.followers.empty())
    return;
  external_ = dead_;
  model::add_follower_forces(model_, t_, u, external_, load_factor_);
}

void Equilibrium::set_load_factor(double factor) {
  load_factor_ = factor;
  dead_ = external_ = model::external_force(model_, t_, factor);
}

VectorXd Equilibrium::controlled_force(const VectorXd& u) const {
  return model_.reduction.gather(model::controlled_force(model_, t_, u));
}

void Equilibrium::take_inertia(const time::Motion& motion) {
  bulk_ = {std::move(bulk_.internal), {}, predicted_bulk_.v, predicted_bulk_.a};
  if (scheme_.dynamic && motion.u != committed_.motion.u) {
    const VectorXd correction = model_.products.mass(motion.a - predicted_acceleration_);
    bulk_.inertia += correction;
    bulk_.momentum += system_.coefficients.velocity / system_.coefficients.acceleration * correction;
  }
  if (model::is_damped(model_))
    bulk_.viscous = model::damping_force(model_, motion.u, motion.v);
}

void Equilibrium::evaluate(const time::Motion& motion, const ContactForce& contact) {
  take_motion(motion);
  sum_up(contact);
}

void Equilibrium::evaluate_ahead(const time::Motion& motion, const ContactForce& contact,
                                 const BulkStart& start) {
  evaluated_at_.reset();
  failed_.reset();
  take_loads(committed_.motion.u);
  const double part = scheme_.forces.now / scheme_.internal_weight(); // of the whole step: half of the end
  const VectorXd moved = part * (motion.u - committed_.motion.u);
  bulk_.internal =
      start.forces +
      linalg::summed(linalg::symmetric_product(matrix_of(model_, start.tangent), moved), model_.sharing());
  take_inertia(motion);
  sum_up(contact);
}

void Equilibrium::sum_up(const ContactForce& contact) {
  inertia_ = scheme_.inertia.now * bulk_.inertia;
  if (bulk_.viscous.size() > 0)
    inertia_ += scheme_.damping.now * bulk_.viscous;
  bracket_ = -external_;
  if (scheme_.remembers_internal())
    bracket_ += bulk_.internal;
  full_residual_ =
      inertia_ + scheme_.forces.now * bracket_ + scheme_.contact_weight() * contact.all + history_;
  if (!scheme_.remembers_internal())
    full_residual_ += bulk_.internal;
  residual_ = model_.reduction.gather(full_residual_);
}

double Equilibrium::unbalanced_with(const VectorXd& contact) const {
  return (residual_ + model_.reduction.gather(scheme_.contact_weight() * contact)).lpNorm<Eigen::Infinity>();
}

VectorXd Equilibrium::residual_without(const ContactForce& contact) const {
  return residual_ - model_.reduction.gather(scheme_.contact_weight() * contact.all);
}

void Equilibrium::measure(const time::Motion& motion, const ContactForce& contact, StepReport& report) {
  VectorXd reference =
      scheme_.forces.now * external_ - scheme_.contact_weight() * contact.nodal - inertia_ - history_;
  for (const int dof : model_.reduction.reacting_dofs())
    reference[dof] -= full_residual_[dof];
  scale_ = reference.lpNorm<Eigen::Infinity>();
  if (scheme_.dynamic)
    scale_ = std::max(scale_, bulk_.momentum.lpNorm<Eigen::Infinity>() * system_.coefficients.acceleration *
                                  system_.step);
  // Bodies that press each other without loads, as in a shrink fit, have reactions of rounding only.
  scale_ = std::max(scale_, least_scale * scheme_.contact_weight() * contact.all.lpNorm<Eigen::Infinity>());
  // Bodies that expand freely have no other forces.
  scale_ = std::max(scale_, scheme_.forces.now * heat_);
  own_scale_ = scale_;
  // Where loads go back to zero nothing is left to measure by but what there was when the step began.
  if (!scheme_.dynamic)
    scale_ = std::max(scale_, committed_.force_scale);
  Index worst = 0;
  for (Index i = 1; i < residual_.size(); ++i)
    if (std::abs(residual_[i]) > std::abs(residual_[worst]))
      worst = i;
  const double largest = residual_.size() > 0 ? std::abs(residual_[worst]) : 0.0;
  // Where nothing but rounding is left there is no force to measure it by: a body that moves without
  // strain.
  const double moved = std::min(motion.u.lpNorm<Eigen::Infinity>(), reach_);
  const double rounding = tolerances.rounding() * system_.diagonal.lpNorm<Eigen::Infinity>() * moved;
  report.unbalanced_force = largest;
  report.residual = largest == 0 || std::max(largest, scale_) <= rounding ? 0 : largest / scale_;
  report.worst_node = residual_.size() > 0
                          ? model_.node_of(model_.reduction.free_dofs()[static_cast<std::size_t>(worst)])
                          : -1;
}

bool Equilibrium::within_rounding(const time::Motion& motion, const ContactStiffness& stiffness, double far,
                                  double tolerance) const {
  VectorXd moved = motion.u;
  for (double& value : moved)
    value = std::min(std::abs(value), reach_);
  VectorXd summed = VectorXd::Zero(moved.size());
  add_magnitudes(system_.coefficients.stiffness, model_.domain.initial_tangent(), moved, summed);
  if (scheme_.dynamic)
    add_magnitudes(system_.coefficients.acceleration * scheme_.inertia.now, model_.mass, moved, summed);
  summed = linalg::summed(std::move(summed), model_.sharing());
  add_contact(stiffness, far, moved.lpNorm<Eigen::Infinity>(), summed);
  const VectorXd level = tolerances.rounding() * model_.reduction.gather_magnitudes(summed);
  for (Index i = 0; i < residual_.size(); ++i)
    if (!(std::abs(residual_[i]) <= std::max(level[i], tolerance * scale_)))
      return false;
  return true;
}

/// A contact force follows the gap by the stiffness there, and a gap is a difference of places; friction
/// follows the slip, a difference of displacements.
void Equilibrium::add_contact(const ContactStiffness& stiffness, double far, double moved,
                              VectorXd& summed) const {
  for (const auto& zone : model_.zones)
    for (const auto* surface : {&zone.master, &zone.slave})
      for (const auto node : surface->nodes) {
        const double place = model_.mesh.points[static_cast<std::size_t>(node)].lpNorm<Eigen::Infinity>();
        for (int i = 0; i < model_.dofs.components; ++i) {
          const int dof = model_.dofs.dof(node, i);
          summed[dof] +=
              stiffness.by_position[dof] * (place + far) + stiffness.by_displacement[dof] * (moved + far);
        }
      }
}

std::vector<WorstNode> Equilibrium::worst() const {
  std::vector<mesh::NodeIndex> nodes;
  nodes.reserve(model_.reduction.free_dofs().size());
  for (const int dof : model_.reduction.free_dofs())
    nodes.push_back(model_.node_of(dof));
  return worst_nodes(residual_, nodes, scale_);
}

/// What the balance of energy needs, and the next step's tangent.
void Equilibrium::record(State& trial) const {
  model_.domain.evaluate(span_to(trial.motion.u), committed_.bulk_points, trial.bulk_points,
                         {.records = true});
  trial.tangent = system_.tangent;
  if (!scheme_.dynamic)
    trial.moved = trial.motion.u - committed_.motion.u;
}

void Equilibrium::finish(const ContactForce& contact, State& trial) const {
  trial.t = t_;
  trial.step = system_.step;
  trial.bulk = bulk_;
  trial.bulk_points = bulk_points_;
  if (!model_.domain.is_linear())
    record(trial);
  trial.force_scale = own_scale_;
  trial.residual_force = bracket_;
  if (scheme_.remembers_contact())
    trial.residual_force += contact.all - contact.forgotten;
  trial.contact_force = contact.all;
  trial.external_force = external_;
  trial.load_factor = load_factor_;
  trial.reaction = model_.reduction.reaction(full_residual_);
}

} // namespace rubato::step
