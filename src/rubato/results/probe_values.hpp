// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the probes of a study have at an instant: a line of probes.csv.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"

#include <string>
#include <vector>

namespace rubato::results {

/// Of each probe in the study's order "name.component", "name" for scalars.
std::vector<std::string> probe_columns(const model::Model& model);

/// Appends one number a column. Stresses and strains are recovered, and contact is brought to the nodes,
/// only when a probe asks for them.
void add_probe_values(const model::Model& model, const step::State& state, std::vector<double>& row);

} // namespace rubato::results
