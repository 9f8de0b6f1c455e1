// SPDX-License-Identifier: LGPL-3.0-or-later
/// Edges of surfaces in mortar contact, of which whoever runs the model should know.
///
/// Mortar contact keeps gaps closed in the mean over the slave's faces, weighted by functions that are
/// negative on a part of each face. Where one of the surfaces has an edge, a gap that opens beside it counts
/// as an overlap there: bodies are held apart by a part of a face's size, and forces are wrong.
#pragma once

#include "rubato/contact/zone.hpp"
#include "rubato/mesh/mesh.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::model {

/// A sentence for each zone between two meshes by mortar one of whose surfaces has an edge of more than 15°,
/// with the sharpest one. Ties, frozen geometry and surfaces that meet themselves are left alone.
std::vector<std::string> edges_in_mortar_zones(std::span<const contact::Zone> zones, const mesh::Mesh& mesh);

} // namespace rubato::model
