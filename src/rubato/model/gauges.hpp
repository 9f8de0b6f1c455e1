// SPDX-License-Identifier: LGPL-3.0-or-later
/// Neutral motions held: springs without which nothing says where a smooth ring has turned to.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/model/gauge.hpp"
#include "rubato/model/sparse_matrix.hpp"

#include <string>
#include <vector>

namespace rubato::model {

class RigidMotions;

/// One gauge a neutral motion (model/neutral_motions.hpp) of each body; a note of each body for whoever runs
/// the model.
std::vector<Gauge> make_gauges(const Model& model, std::vector<std::string>& notes);

/// Adds k g gᵀ of every gauge, k such that they are as stiff as the bodies are at their nodes; whole blocks.
void add_gauges(const Model& model, SparseMatrix& stiffness);

} // namespace rubato::model
