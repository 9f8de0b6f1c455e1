// SPDX-License-Identifier: LGPL-3.0-or-later
/// Frames of the points that close in a step of a law of velocities.
#pragma once

#include "rubato/contact/discretisation.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::contact {

/// Contact as a law of velocities in a step with u₁ = u₀ + h (θ v₁ + (1−θ) v₀).
struct VelocityLaw {
  double step = 0;
  double theta = 0.5;
  bool massless = false; ///< the slave surface has no momentum: nothing to lose where it hits
};

/// Frozen frames of the points that touch in a step, in which gap and slip are counted so that the
/// same laws that close gaps and hold slips are laws of velocities. With v₀ the velocity at the start of the
/// slave point relative to what it faces, e the restitution (Moreau's law with Newton's restitution):
///   gap = h θ (v₁·n − e ⟨−v₀·n⟩),   slip_a = h θ v₁·τ_a;
/// where v₀ parts the surfaces, or where they have no mass, gap = Δu·n: then pressures do no work in the
/// step, and without mass slip_a = Δu·τ_a: friction takes energy in every step. A point without mass that is
/// open may close in the step: gap = g₀ + Δu·n. Other open points have no kinematics. `velocity`: one a dof;
/// an obstacle has its mean velocity of the step, at the start and at the end; one that rotates that of the
/// place where the point goes with its velocity.
/// Points touch that are not beyond the gap they stand at (`standing`, 0 or where they closed before; one a
/// point), and those whose velocity closes their gap in the first half of the step. The latter stand where
/// they are: what is left open is written to `standing`. Points of a tie, and those that have `touched` in a
/// bilateral zone (one a point, or none), hold whatever their velocity: gap = h θ v₁·n.
std::vector<PointEvaluation> velocity_frames(Discretisation& discretisation, const Configuration& start,
                                             const Eigen::VectorXd& velocity, const VelocityLaw& law,
                                             std::span<double> standing,
                                             std::span<const std::uint8_t> touched = {});

} // namespace rubato::contact
