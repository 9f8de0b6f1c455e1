// SPDX-License-Identifier: LGPL-3.0-or-later
/// Simpson's composite rule on contact faces.
#pragma once

#include "rubato/contact/integration.hpp"

#include <vector>

namespace rubato::contact {

/// Each direction of a face is parted into `parts` ≥ 1 intervals with points at their ends and middles, which
/// has (2 parts + 1) points on segments and their products on quadrangles (degree 3); triangles are parted
/// into parts² triangles with points at corners and middles of edges, weighted 1/30 and 4/30 (degree 1).
/// These are the points and weights of Code_Aster's INTEGRATION='SIMPSON' with ORDRE_INT = parts. Points on
/// nodes are marked as such.
std::vector<IntegrationPoint> simpson_rule(CellType face, int parts);

} // namespace rubato::contact
