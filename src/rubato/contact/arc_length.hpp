// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the contact points of a plane zone stand along its slave.
#pragma once

#include "rubato/contact/zone.hpp"

#include <vector>

namespace rubato::contact {

/// Arc lengths of a zone's points along the undeformed slave, one a point [length]. The faces of a slave in
/// the plane make lines; each is followed so that the body is on its left, from its end or, where it is
/// closed, from its first face. A slave of several lines has them one behind the other, in the order of their
/// first faces. Throws std::invalid_argument for faces in space.
std::vector<double> arc_lengths(const mesh::Mesh& mesh, const Zone& zone);

} // namespace rubato::contact
