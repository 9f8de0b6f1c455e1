// SPDX-License-Identifier: LGPL-3.0-or-later
/// Names of nodes in messages.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <string>

namespace rubato::model {

/// "N90 (1, 0.1, 0.05)": how messages name a node.
std::string node_label(const mesh::Mesh& mesh, mesh::NodeIndex node);

} // namespace rubato::model
