// SPDX-License-Identifier: LGPL-3.0-or-later
/// The motion of surfaces without mass, as results have it.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"

namespace rubato::step {

/// `now`, at the end of a step from `before`, with another motion of nodes without mass. At the end of a step
/// they may have any velocity, which alternates about its mean from step to step. Their velocity is Δu/h
/// here, 0 where they stick, and their acceleration that of their body nearby: of the motion that their
/// inertia has (model/contact_mass.hpp). M v and M a stay what they are.
State with_massless_motion(const model::Model& model, const State& before, State now);

} // namespace rubato::step
