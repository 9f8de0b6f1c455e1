// SPDX-License-Identifier: LGPL-3.0-or-later
/// Surfaces that are tied to one another: what their points have between them where nothing is deformed stays
/// as it is, in every direction.
///
/// The frame of such a point stands along the axes. By mortar each component has a stencil of its own: a
/// slave node that a support holds along an axis has no relation there, and its function goes to the nodes
/// around it (B. Wohlmuth, Acta Numerica 20, 2011, on cross points). A point on a node has none there either.
#pragma once

#include "rubato/contact/enforcement.hpp"

#include <vector>

namespace rubato::contact {

/// The points of a zone with `tie`, of nodes or of mortar, in frames that are held, with derivatives; those
/// that face nothing have no kinematics. A point on a node faces a master within the longest slave face of
/// it, when its projection is not clamped. `rest`: nothing is displaced.
std::vector<PointEvaluation> tied_points(const Zone& zone, const Configuration& rest);

} // namespace rubato::contact
