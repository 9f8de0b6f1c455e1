// SPDX-License-Identifier: LGPL-3.0-or-later
/// Forces of ties that are relations between displacements, as contact zones show them.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/zone_state.hpp"
#include "rubato/model/fwd.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::step {

/// The tied points of one zone.
struct TiedZone {
  std::size_t zone = 0; ///< of the model
  std::vector<contact::PointEvaluation> points;
};

/// Those of a model of an explicit run, in the order of its zones.
std::vector<TiedZone> tied_zones(const model::Model& model);

/// What the tied points do: one state a tied zone. `multipliers`: Reduction::multipliers of the model's
/// reduction; those of ties come first.
std::vector<contact::ZoneState> states_of_ties(const model::Model& model, std::span<const TiedZone> ties,
                                               const Eigen::VectorXd& multipliers);

/// The forces of ties on all dofs, internal side [force].
Eigen::VectorXd forces_of_ties(const model::Model& model, std::span<const TiedZone> ties,
                               const Eigen::VectorXd& multipliers);

} // namespace rubato::step
