// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact pressures at the slave nodes, whatever points carry them.
#pragma once

#include "rubato/contact/enforcement.hpp"

#include <vector>

namespace rubato::contact {

/// One a slave node [pressure]: its multiplier where pressures are multipliers, else the mean of the points
/// around, each with its area and the part of it that the node has.
std::vector<double> nodal_pressure(const Zone& zone, const ZoneState& state);

} // namespace rubato::contact
