// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

namespace rubato {

/// A place that is stored as int or std::int64_t, as the standard containers index; not negative.
constexpr std::size_t at(std::int64_t index) {
  return static_cast<std::size_t>(index);
}

} // namespace rubato
