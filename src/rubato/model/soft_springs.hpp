// SPDX-License-Identifier: LGPL-3.0-or-later
/// Springs that only keep a body from being lost: so soft beside the body itself that contact, not they, says
/// where it is.
#pragma once

#include "rubato/model/fwd.hpp"

namespace rubato::model {

/// Marks the springs of each body whose springs together are softer along every axis than a small part of
/// what the body resists a point of it with. Models without contact, and those with contact that gives way
/// (by penalty), are left as they are.
void mark_soft_springs(Model& model);

} // namespace rubato::model
