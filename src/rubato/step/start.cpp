// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/start.hpp"

#include "rubato/contact/discretisation.hpp"
#include "rubato/core/error.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/model/sparse_matrix.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Residual of M a = f that counts as rounding, relative.
constexpr double solved = 1e-15;
/// The same where rounding stops the iterations before.
constexpr double solved_well = 1e-12;

/// A consistent mass scaled by its diagonal is well conditioned whatever the mesh (A. J. Wathen, Realistic
/// eigenvalue bounds for the Galerkin mass matrix, IMA J. Numer. Anal. 7 (1987) 449–457), so conjugate
/// gradients need few iterations.
VectorXd solve_mass(const model::SparseMatrix& mass, const VectorXd& force) {
  Eigen::ConjugateGradient<model::SparseMatrix, Eigen::Lower | Eigen::Upper> solver;
  solver.setTolerance(solved);
  const bool positive = mass.rows() == 0 || mass.diagonal().minCoeff() > 0;
  VectorXd a = positive ? VectorXd(solver.compute(mass).solve(force)) : VectorXd();
  if (!positive || !(solver.error() <= solved_well))
    throw InputError(
        "the mass matrix is not positive definite: every cell of a dynamic run needs a positive density");
  return a;
}

/// M a = −(residual force + C v) on the free dofs, a = 0 where nothing has mass; `given`: what supports and
/// relations give of a, 0 on free dofs.
VectorXd balanced_acceleration(const Model& model, const VectorXd& residual_force, const time::Motion& motion,
                               const VectorXd& given) {
  VectorXd force = -residual_force;
  if (!given.isZero(0))
    force -= linalg::product_of(model.mass, given, model.sharing());
  if (model::is_damped(model))
    force -= model::damping_force(model, motion.u, motion.v);
  auto mass = linalg::whole_of(model.reduction.reduced(model.mass), model.sharing());
  for (const auto node : model.massless_nodes)
    for (int i = 0; i < model.dofs.components; ++i) {
      const int dof = model.dofs.dof(node, i);
      force[dof] = 0;
      if (const int row = model.reduction.unknown_of(dof); row >= 0 && mass.coeff(row, row) == 0)
        mass.coeffRef(row, row) = 1;
    }
  // There before the temporaries of the solution: among them it would keep their memory from being given
  // back.
  VectorXd a = VectorXd::Zero(residual_force.size());
  a(model.reduction.free_dofs()) = solve_mass(mass, model.reduction.gather(force));
  model.reduction.relate(a);
  a += given;
  return a;
}

/// The accelerations that supports give at the begin of a run.
VectorXd given_acceleration(const Model& model, double t) {
  VectorXd a = VectorXd::Zero(static_cast<Index>(model.dofs.dof_count));
  model.reduction.impose_rates(2, t, a);
  return a;
}

/// What of a motion that goes on supports and relations give.
VectorXd given_part_of(const constraint::Reduction& reduction, const VectorXd& a) {
  VectorXd given = VectorXd::Zero(a.size());
  for (const auto& support : reduction.prescribed())
    given[support.dof] = a[support.dof];
  for (const auto& dependent : reduction.dependents()) {
    given[dependent.dof] = a[dependent.dof];
    for (const auto& term : dependent.of)
      given[dependent.dof] -= term.coefficient * a[term.dof];
  }
  return given;
}

/// A zone before the first step: its gaps are known, nothing pushes yet.
contact::ZoneState untouched_zone(const Model& model, const contact::Zone& zone, const VectorXd& u,
                                  double t) {
  auto state = contact::initial_state(zone);
  const auto points = contact::evaluate(zone, state.multipliers, {&model.mesh, &model.dofs, &u, &u, t, t});
  const std::vector<contact::Status> open(points.size(), contact::Status::open);
  state.outcomes = contact::outcomes({.zone = &zone}, points, open);
  return state;
}

void refuse(const Model& model, const domain::Failed& failed) {
  if (failed)
    throw InputError(
        fmt::format("{} has no forces where the run begins: {}; expected initial displacements and "
                    "supports that deform it less",
                    domain::cell_label(model.mesh, failed->cell), element::described(failed->reason)));
}

/// With those that follow their faces [force].
VectorXd loads(const Model& model, const State& state) {
  VectorXd force = model::external_force(model, state.t, state.load_factor);
  model::add_follower_forces(model, state.t, state.motion.u, force, state.load_factor);
  return force;
}

/// Loads along a path begin from nothing.
double first_load_factor(const Model& model) {
  return model.study.time.arc_length ? 0 : 1;
}

/// Without a step: at the state's displacements, from the state that the materials are in.
VectorXd internal_forces(const Model& model, const State& state) {
  const auto& u = state.motion.u;
  VectorXd forces;
  domain::QuadratureStates unchanged;
  refuse(model,
         model.domain.evaluate({u, u, state.t, state.t}, state.bulk_points, unchanged, {.forces = &forces}));
  return forces;
}

/// The bodies come to the initial displacements from their undeformed shape at once.
void deform(const Model& model, State& state) {
  const VectorXd undeformed = VectorXd::Zero(state.motion.u.size());
  refuse(model, model.domain.evaluate({undeformed, state.motion.u, state.t, state.t},
                                      model.domain.initial_states(), state.bulk_points, {.records = true}));
}

/// What the model's materials make of a state that another run has left: they may have other numbers than
/// those of that run.
void take_states(const Model& model, State& state) {
  const auto& u = state.motion.u;
  const auto left = std::exchange(state.bulk_points, {});
  refuse(model, model.domain.evaluate({u, u, state.t, state.t}, left, state.bulk_points, {.records = true}));
}

/// Internal, loads' and contact forces of the start as the first step takes them, of those that it takes.
VectorXd first_bracket(const time::Scheme& scheme, const VectorXd& internal, const VectorXd& loaded) {
  return scheme.remembers_internal() ? VectorXd(internal - loaded) : VectorXd(-loaded);
}

} // namespace

BulkForces bulk_forces(const Model& model, const State& state) {
  const auto& motion = state.motion;
  BulkForces forces{
      internal_forces(model, state), {}, model.products.mass(motion.v), model.products.mass(motion.a)};
  if (model::is_damped(model))
    forces.viscous = model::damping_force(model, motion.u, motion.v);
  return forces;
}

State initial_state(const Model& model, const time::Scheme& scheme, double t, bool loaded_history) {
  const auto size = static_cast<Index>(model.dofs.dof_count);
  State state;
  state.t = t;
  state.load_factor = first_load_factor(model);
  state.motion = {model.initial.displacement, model.initial.velocity, VectorXd::Zero(size)};
  model.reduction.impose(t, state.motion.u);
  model.reduction.relate(state.motion.v);
  model.reduction.impose_rates(1, t, state.motion.v);
  deform(model, state);
  const VectorXd internal = internal_forces(model, state), loaded = loads(model, state);
  state.residual_force = first_bracket(scheme, internal, loaded);
  state.contact_force = VectorXd::Zero(size);
  state.friction_force = VectorXd::Zero(size);
  state.reaction = VectorXd::Zero(size);
  state.shortening = VectorXd::Zero(static_cast<Index>(model.preloads.size()));
  for (const auto& zone : model.zones)
    state.zones.push_back(untouched_zone(model, zone, state.motion.u, t));
  if (scheme.dynamic)
    state.motion.a =
        balanced_acceleration(model, internal - loaded, state.motion, given_acceleration(model, t));
  if (!loaded_history)
    state.residual_force.setZero();
  state.bulk = bulk_forces(model, state);
  state.external_force = loaded;
  return state;
}

State continued_state(const Model& model, const time::Scheme& scheme, const State& end, double t) {
  State state = end;
  state.shortening = VectorXd::Zero(static_cast<Index>(model.preloads.size()));
  for (auto& zone : state.zones)
    std::ranges::fill(zone.friction_history, contact::FrictionHistory());
  state.t = t;
  state.load_factor = first_load_factor(model);
  state.step = 0; // the acceleration that follows is that of the instant, not of the last step
  state.tangent.reset();
  if (scheme.dynamic)
    model.reduction.impose_rates(1, t, state.motion.v);
  if (!model.domain.is_linear() &&
      state.bulk_points.values.size() != model.domain.initial_states().values.size())
    deform(model, state);
  else
    take_states(model, state);
  const VectorXd internal = internal_forces(model, state), loaded = loads(model, state);
  state.residual_force = first_bracket(scheme, internal, loaded);
  VectorXd unbalanced = internal - loaded;
  if (scheme.remembers_contact()) {
    state.residual_force += state.contact_force;
    unbalanced += state.contact_force;
  }
  if (scheme.dynamic)
    state.motion.a = balanced_acceleration(model, unbalanced, state.motion, given_acceleration(model, t));
  state.bulk = bulk_forces(model, state);
  state.external_force = loaded;
  if (state.friction_force.size() != state.contact_force.size()) // explicit runs don't keep it apart
    state.friction_force = VectorXd::Zero(state.contact_force.size());
  return state;
}

void release(const Model& model, const time::Scheme& scheme, State& state) {
  state.tangent.reset();                   // springs of gauges may be others
  if (!scheme.dynamic || scheme.nonsmooth) // a is none, or the mean of the step before
    return;
  state.step = 0; // as of a run that continues another one
  state.residual_force = state.bulk.internal - state.external_force;
  if (scheme.remembers_contact())
    state.residual_force += state.contact_force;
  state.motion.a = balanced_acceleration(model, state.residual_force, state.motion,
                                         given_part_of(model.reduction, state.motion.a));
  state.bulk.inertia = model.products.mass(state.motion.a);
}

} // namespace rubato::step
