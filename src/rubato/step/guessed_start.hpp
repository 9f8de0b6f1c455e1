// SPDX-License-Identifier: LGPL-3.0-or-later
/// The start of a step that is solved whole, on a bulk whose effective matrix is factored: the motion, the
/// statuses and the multipliers that belong to a guess of the contact forces (step/contact_guess.hpp).
#pragma once

#include "rubato/step/contact_side.hpp"
#include "rubato/step/equilibrium.hpp"
#include "rubato/step/pulse.hpp"

namespace rubato::step {

/// Takes `trial` there from the motion that it has. Nothing of it is changed when the forces are not finite;
/// it means nothing when the pulse has stopped.
void start_from_guess(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                      const ContactSide& side, const Held& held, Equilibrium& equilibrium, State& trial,
                      Pulse& pulse);

} // namespace rubato::step
