// SPDX-License-Identifier: LGPL-3.0-or-later
/// Lists of nodes or cells by their indices.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rubato::mesh {

/// Ascending, each index once.
inline void sort_without_repeats(std::vector<std::int32_t>& items) {
  std::ranges::sort(items);
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

} // namespace rubato::mesh
