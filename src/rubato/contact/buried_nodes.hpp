// SPDX-License-Identifier: LGPL-3.0-or-later
/// Master nodes behind the slave.
///
/// Contact tests the slave's points against the master, not the master's nodes against the slave: what is
/// smaller than a slave face may sink into it between its nodes, by nodes and by mortar alike. Whoever wants
/// to know looks here.
#pragma once

#include "rubato/contact/zone.hpp"

#include <vector>

namespace rubato::contact {

/// By position in the master's nodes, how far each lies behind a slave face that looks at it [length]; 0
/// where none does. Faces around the nearest slave node are looked at, inside their limits. Of a zone with a
/// meshed master.
std::vector<double> buried_depths(const Zone& zone, const Configuration& configuration);

/// By the same positions, the shortest edge of the faces around each node, undeformed [length].
std::vector<double> edges_around(const mesh::Mesh& mesh, const Surface& surface);

} // namespace rubato::contact
