// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

namespace rubato {

/// A place that is stored as int, as the standard containers index; not negative.
constexpr std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

} // namespace rubato
