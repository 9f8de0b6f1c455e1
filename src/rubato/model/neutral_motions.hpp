// SPDX-License-Identifier: LGPL-3.0-or-later
/// Rigid motions that nothing resists but the facets of a mesh: a smooth ring turns about itself.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/model/rigid_motions.hpp"

#include <vector>

namespace rubato::model {

/// Of each body the rigid motions that supports and firm springs leave it, that carry its contact surfaces
/// into themselves but for their facets, that friction does not resist, that no load works on and along which
/// soft springs do not pull when the body is shifted; bodies ascending. `rigid` has firm supports.
///
/// A surface is carried into itself where r is tangential to it: where ν·r with the normals ν averaged at its
/// nodes is small beside n·r with the normals of its faces, which is what angles between facets leave. What
/// facets do not resist either is not among them.
std::vector<RigidMotion> neutral_motions(const Model& model, const RigidMotions& rigid);

} // namespace rubato::model
