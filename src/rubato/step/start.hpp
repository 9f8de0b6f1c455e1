// SPDX-License-Identifier: LGPL-3.0-or-later
/// The state a run begins with.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

namespace rubato::step {

/// f_int, C v, M v and M a of a state's motion, where the materials are as the state has them.
BulkForces bulk_forces(const model::Model& model, const State& state);

/// The model's initial motion, imposed displacements applied, M a = external − internal − damping force.
/// `loaded_history` false takes the first history bracket as zero (Code_Aster's start). Materials come to the
/// initial displacements from the undeformed shape at once. Throws InputError when the mass matrix is
/// singular or a cell has no forces there.
State initial_state(const model::Model& model, const time::Scheme& scheme, double t, bool loaded_history);

/// Continues another run's end: u, multipliers, statuses and what materials remember are kept; velocity too
/// when both runs are dynamic. Materials that have nothing of the other run to remember come to its
/// displacements at once. The acceleration follows from equilibrium with the contact forces in place. Throws
/// InputError as initial_state does.
State continued_state(const model::Model& model, const time::Scheme& scheme, const State& end, double t);

/// Where supports have ended, at an instant of the run: u, v and contact are kept, the acceleration follows
/// from equilibrium without them. `model`: from that instant on.
void release(const model::Model& model, const time::Scheme& scheme, State& state);

} // namespace rubato::step
