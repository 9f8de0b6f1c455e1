// SPDX-License-Identifier: LGPL-3.0-or-later
/// The state a run begins with.
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

namespace rubato::step {

/// f_int, C v, M v and M a of a state's motion, where the materials are as the state has them.
BulkForces bulk_forces(const model::Model& model, const State& state);

/// The model's initial motion, imposed displacements applied, M a = external − internal − damping force.
/// `loaded_history` false takes the first history bracket as zero (Code_Aster's start). Throws InputError
/// when the mass matrix is singular.
State initial_state(const model::Model& model, const time::Scheme& scheme, double t, bool loaded_history);

/// Continues another run's end: u, multipliers and statuses are kept; velocity too when both runs are
/// dynamic; the acceleration follows from equilibrium with the contact forces in place.
State continued_state(const model::Model& model, const time::Scheme& scheme, const State& end, double t);

/// Where supports have ended, at an instant of the run: u, v and contact are kept, the acceleration follows
/// from equilibrium without them. `model`: from that instant on.
void release(const model::Model& model, const time::Scheme& scheme, State& state);

} // namespace rubato::step
