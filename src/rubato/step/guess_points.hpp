// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact points of a model as the guess of a step's contact sees them.
#pragma once

#include "rubato/step/contact_guess.hpp"
#include "rubato/step/contact_side.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::step {

/// Every point that may touch, in the frame where `contact` measured it with the surface at d = `moved`.
/// Forces are taken from the last step's outcomes in `state`, or kept from what `points` hold already.
/// Whether these are the points they were.
enum class GuessForces { of_last_step, kept };
bool measure_points(const model::Model& model, const ContactSide& side, const Held& held,
                    const Compliance& compliance, const ContactIterate& contact, const Eigen::VectorXd& moved,
                    const State& state, GuessForces forces, std::vector<GuessPoint>& points);

/// What their forces put on the surface, internal side, one a position [force].
Eigen::VectorXd force_on_surface(std::span<const GuessPoint> points, Eigen::Index positions);

/// Statuses and multipliers that belong to the guessed forces.
void take_guess(const model::Model& model, std::span<const GuessPoint> points, State& state);

} // namespace rubato::step
