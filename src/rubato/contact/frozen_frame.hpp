// SPDX-License-Identifier: LGPL-3.0-or-later
/// Kinematics of points whose place on the master and frame a loop holds.
#pragma once

#include "rubato/contact/kinematics.hpp"

namespace rubato::contact {

/// The same point with its place on the master, normal and tangents held: only gap and slip follow the
/// bodies. The relation is linear in q then.
Kinematics with_frozen_frame(Kinematics kinematics);

/// One place of a point that two faces claim in turn: their held frames half each, with the normal between
/// theirs. It knows the nodes of both.
Kinematics frozen_between(const Kinematics& a, const Kinematics& b);

/// Gap and slip of a held frame at another configuration.
void measure_in_frozen_frame(Kinematics& kinematics, const Configuration& configuration);

} // namespace rubato::contact
