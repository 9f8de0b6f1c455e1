// SPDX-License-Identifier: LGPL-3.0-or-later
/// The three nested levels of a contact step: geometry ⊃ friction threshold ⊃ status, each either part of
/// every Newton iteration or a loop of its own around them, zone by zone.
#pragma once

#include "rubato/step/common/contact_evaluator.hpp"

#include <functional>

namespace rubato::step {

/// Goes from `trial` to the end of the step with whatever the loops hold.
using Solve = std::function<StepReport(State& trial, const Frozen& frozen)>;

/// What the changes to come add up to, if they go on as a geometric series; infinity where they do not
/// shrink. Rounds that creep settle nothing, however little each of them changes.
double further_changes(double change, double change_before);

/// Solves the step from `trial` on. Where zones differ, a loop takes the strictest tolerance and the largest
/// number of rounds among those that have it.
///   geometry: ends when u of two rounds differs by at most tolerance × what the former moved since the start
///     of the step, not before the second round (Code_Aster's RESI_GEOM with REAC_GEOM='AUTOMATIQUE'); where
///     it is a loop that a failed Newton asked for, the further changes count, too, in the last round;
///   friction: when no friction pressure changes by more than tolerance × the largest one;
///   status: when no point's status changes.
StepReport solve_levels(const model::Model& model, const ContactEvaluator& side, const Solve& solve,
                        const State& committed, State& trial);

} // namespace rubato::step
