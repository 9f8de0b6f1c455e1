// SPDX-License-Identifier: LGPL-3.0-or-later
/// Balance that no contact could give: points that press where their master is not.
///
/// Iterations may end with forces in balance and gaps closed in the mean although a point is nowhere near the
/// surface that it presses: parts of the master that lie before and behind it made its gap. A point of mortar
/// stands for the faces around its node, so the master's nearest node is within a face of each.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

#include <optional>

namespace rubato::step {

/// Criterion::distance for the point of all mortar zones between two surfaces, of methods that close gaps,
/// that presses farthest from the nearest node of its master, where that is more than the longest faces of
/// both, its gap, and what the zone adds to gaps.
std::optional<Unmet> pressed_afar(const model::Model& model, const State& state);

} // namespace rubato::step
