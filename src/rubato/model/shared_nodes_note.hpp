// SPDX-License-Identifier: LGPL-3.0-or-later
/// Slave nodes in several zones, of which whoever runs the model should know.
#pragma once

#include "rubato/model/fwd.hpp"

#include <optional>
#include <string>

namespace rubato::model {

/// What happens to the friction of such nodes (contact/shared_nodes.hpp), and where the first of them is.
/// Nothing where there are none, and in explicit runs, where friction is that of each zone.
std::optional<std::string> note_on_shared_nodes(const Model& model);

} // namespace rubato::model
