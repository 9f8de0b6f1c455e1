// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/told_state.hpp"

#include "rubato/domain/rank_states.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/time/scheme.hpp"

#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;
using model::Model;
using model::SparseMatrix;

bool steps_explicitly(const Model& model) {
  return study::is_explicit(model.study.time.scheme);
}

/// Of explicit runs the domain is that of this rank alone.
VectorXd end_forces(const Model& model, const State& state) {
  VectorXd forces;
  domain::QuadratureStates unchanged;
  const auto& u = state.motion.u;
  model.domain.evaluate({u, u, state.t, state.t}, state.bulk_points, unchanged, {.forces = &forces});
  return steps_explicitly(model) ? linalg::summed(std::move(forces), model.sharing()) : forces;
}

/// Whether BulkForces::internal is something else.
bool lacks_end_forces(const Model& model) {
  return steps_explicitly(model) || time::make_scheme(model.study.time).conserving;
}

domain::QuadratureStates whole_points(const Model& model, domain::QuadratureStates own) {
  return domain::whole_states(std::move(own), model.mesh, model.bulk, *model.parts);
}

/// In how many ranks' parts each entry stands.
SparseMatrix counts_of(const Model& model) {
  auto ones = model.domain.initial_tangent();
  ones.coeffs().setOnes();
  return linalg::whole_of(ones, model.sharing());
}

Tangent whole_tangent(const Model& model, const Tangent& own) {
  return own ? values_of(linalg::whole_of(matrix_of(model, own), model.sharing())) : nullptr;
}

/// Of each entry as large a part as the others have that have it.
Tangent part_of_tangent(const Model& model, const Tangent& whole) {
  if (!whole)
    return nullptr;
  auto shares = counts_of(model);
  shares.coeffs() = whole->array() / shares.coeffs();
  auto part = model.domain.initial_tangent();
  for (int column = 0; column < part.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(part, column); entry; ++entry)
      entry.valueRef() = shares.coeff(entry.row(), column);
  return values_of(part);
}

} // namespace

ToldState::ToldState(const Model& model, const State& state) : state_(&state) {
  if (!model.parts)
    return;
  whole_ = state;
  if (lacks_end_forces(model))
    whole_->bulk.internal = end_forces(model, state);
  if (!steps_explicitly(model)) // explicit motion tells whole ones
    whole_->bulk_points = whole_points(model, std::move(whole_->bulk_points));
}

State kept_state(const Model& model, const State& state) {
  if (!model.parts || steps_explicitly(model))
    return state;
  State kept = state;
  kept.bulk_points = whole_points(model, std::move(kept.bulk_points));
  kept.tangent = whole_tangent(model, kept.tangent);
  return kept;
}

State resumed_state(const Model& model, State kept) {
  if (!model.parts || steps_explicitly(model))
    return kept;
  kept.bulk_points = domain::own_states(std::move(kept.bulk_points), model.mesh, model.bulk, *model.parts);
  kept.tangent = part_of_tangent(model, kept.tangent);
  return kept;
}

} // namespace rubato::step
