// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/direct_solver.hpp"
#include "rubato/step/newton.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Model;
using model::SparseMatrix;

SparseMatrix free_part(const Model& model, const SparseMatrix& matrix) {
  const auto size = static_cast<Index>(model.free_dofs.size());
  std::vector<Eigen::Triplet<double, int>> triplets;
  triplets.reserve(static_cast<std::size_t>(matrix.nonZeros()));
  for (int column = 0; column < matrix.outerSize(); ++column) {
    const int free_column = model.free_index[static_cast<std::size_t>(column)];
    if (free_column < 0)
      continue;
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (const int free_row = model.free_index[static_cast<std::size_t>(entry.row())]; free_row >= 0)
        triplets.emplace_back(free_row, free_column, entry.value());
  }
  SparseMatrix part(size, size);
  part.setFromTriplets(triplets.begin(), triplets.end());
  return part;
}

void apply_imposed(const Model& model, double t, VectorXd& u) {
  const VectorXd imposed = model::imposed_displacements(model, t);
  for (std::size_t i = 0; i < model.constraints.size(); ++i)
    u[model.constraints[i].dof] = imposed[static_cast<Index>(i)];
}

/// M a = −(unbalance + C v) on the free dofs, a = 0 on the others.
VectorXd balanced_acceleration(const Model& model, const VectorXd& unbalance, const VectorXd& velocity) {
  const auto factor = linalg::CholeskyFactor::of(free_part(model, model.mass));
  if (!factor)
    throw InputError(
        "the mass matrix is not positive definite: every cell of a dynamic run needs a positive density");
  VectorXd force = -unbalance;
  if (model.damping.nonZeros() > 0)
    force -= model.damping * velocity;
  VectorXd a = VectorXd::Zero(unbalance.size());
  a(model.free_dofs) = factor->solve(VectorXd(force(model.free_dofs)));
  return a;
}

} // namespace

EffectiveSystem make_effective_system(const Model& model, const time::Scheme& scheme, double step,
                                      LinearEngine engine) {
  EffectiveSystem system;
  system.step = step;
  system.coefficients = time::coefficients_of(scheme, step);
  SparseMatrix full = system.coefficients.stiffness * model.stiffness;
  if (system.coefficients.mass != 0)
    full += system.coefficients.mass * model.mass;
  if (system.coefficients.damping != 0 && model.damping.nonZeros() > 0)
    full += system.coefficients.damping * model.damping;
  system.diagonal = full.diagonal();
  system.matrix = free_part(model, full);
  for (const auto& zone : model.zones)
    system.zones.push_back(contact::automatic_coefficients(zone, model.dofs, system.diagonal));
  if (engine == LinearEngine::automatic)
    if (auto factor = linalg::CholeskyFactor::of(system.matrix))
      system.compliance.emplace(std::move(*factor), surface_unknowns(model), system.matrix.rows());
  return system;
}

State initial_state(const Model& model, const time::Scheme& scheme, double t, bool loaded_history) {
  const auto size = static_cast<Index>(model.dofs.dof_count);
  State state;
  state.t = t;
  state.motion = {VectorXd::Zero(size), VectorXd::Zero(size), VectorXd::Zero(size)};
  apply_imposed(model, t, state.motion.u);
  state.unbalance = model.stiffness * state.motion.u - model::external_force(model, t);
  state.contact_force = VectorXd::Zero(size);
  state.reaction = VectorXd::Zero(size);
  for (const auto& zone : model.zones)
    state.zones.push_back(contact::initial_state(zone));
  if (scheme.dynamic)
    state.motion.a = balanced_acceleration(model, state.unbalance, state.motion.v);
  if (!loaded_history)
    state.unbalance.setZero();
  return state;
}

State continued_state(const Model& model, const time::Scheme& scheme, const State& end, double t) {
  State state = end;
  state.t = t;
  state.unbalance = model.stiffness * state.motion.u + state.contact_force - model::external_force(model, t);
  if (scheme.dynamic)
    state.motion.a = balanced_acceleration(model, state.unbalance, state.motion.v);
  return state;
}

} // namespace rubato::step
