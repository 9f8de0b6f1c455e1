// SPDX-License-Identifier: LGPL-3.0-or-later
/// Edges of surfaces in mortar contact, of which whoever runs the model should know.
///
/// A slave node has one normal, the mean of its faces'. At an edge it is that of no side: the node is pressed
/// askew, and its gap is not that of either face. Above 60° edges are split (contact/sharp_edges.hpp),
/// masters may have any.
#pragma once

#include "rubato/contact/zone.hpp"
#include "rubato/mesh/mesh.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::model {

/// A sentence for each zone between two meshes by mortar whose slave has an edge between 15° and 60°, with
/// the sharpest of these. Ties, frozen geometry and surfaces that meet themselves are left alone.
std::vector<std::string> edges_in_mortar_zones(std::span<const contact::Zone> zones, const mesh::Mesh& mesh);

} // namespace rubato::model
