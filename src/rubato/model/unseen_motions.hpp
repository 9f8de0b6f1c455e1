// SPDX-License-Identifier: LGPL-3.0-or-later
/// Cells of lower order that can deform without strain at their points.
#pragma once

#include "rubato/model/fwd.hpp"

#include <string>
#include <vector>

namespace rubato::model {

/// One sentence for each material with reduced QUAD8 or HEXA20 that neighbours do not keep in shape. A QUAD8
/// needs one neighbour: two that share an edge cannot both deform without strain. Rows of HEXA20 that are one
/// cell wide in two directions can. A side that supports hold in one component counts as a neighbour. Of a
/// model that has its reduction.
std::vector<std::string> notes_on_unseen_motions(const Model& model);

} // namespace rubato::model
