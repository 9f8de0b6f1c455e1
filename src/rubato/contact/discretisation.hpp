// SPDX-License-Identifier: LGPL-3.0-or-later
/// How the points of a zone are measured from one configuration to the next: against the face that each of
/// them faces, by mortar integrals, or as either has them where nothing is deformed.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/frozen_points.hpp"
#include "rubato/contact/mortar/points.hpp"
#include "rubato/contact/neighbours.hpp"

#include <Eigen/Core>

#include <span>
#include <variant>
#include <vector>

namespace rubato::contact {

/// With what it keeps from one configuration to the next.
using Discretisation = std::variant<NeighbourList, mortar::Points, FrozenPoints>;

/// Of a zone that outlives it. `threads`: that integrals between its surfaces may use.
Discretisation make_discretisation(const Zone& zone, const Threads& threads = {});

const Zone& zone_of(const Discretisation& discretisation);

/// A step begins from that state.
void begin_step(Discretisation& discretisation, const ZoneState& committed);
/// Newton's iterations begin: what points have visited is counted from there.
void forget_visits(Discretisation& discretisation);
/// Lets points go that stay on a face they stand beyond (neighbours.hpp). Whether there were any.
bool release_beyond_borders(Discretisation& discretisation);

/// Gaps, slips and multipliers of a zone's points, with their derivatives.
std::vector<PointEvaluation> evaluate(const Zone& zone, const Eigen::VectorXd& multipliers,
                                      const Configuration& configuration);

/// The same in the storage that an earlier evaluation left in `into`.
void evaluate(Discretisation& discretisation, const Eigen::VectorXd& multipliers,
              const Configuration& configuration, std::vector<PointEvaluation>& into);
/// The same without derivatives.
void measure(Discretisation& discretisation, const Eigen::VectorXd& multipliers,
             const Configuration& configuration, std::vector<PointEvaluation>& into);
/// The same of some of the points: the others stay as `into` has them.
void measure(Discretisation& discretisation, const Eigen::VectorXd& multipliers,
             const Configuration& configuration, std::span<const std::size_t> points,
             std::vector<PointEvaluation>& into);

} // namespace rubato::contact
