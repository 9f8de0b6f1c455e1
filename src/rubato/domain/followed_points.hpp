// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "rubato/domain/bulk.hpp"

#include <cstddef>

namespace rubato::domain {

/// How many points of a cell, by its place in the bulk, a path follows (LawPath::points).
std::size_t followed_points(const Bulk& bulk, std::size_t cell, CellType type);

} // namespace rubato::domain
