// SPDX-License-Identifier: LGPL-3.0-or-later
/// The time that the processor has spent on this program.
#pragma once

#include <ctime>

namespace rubato {

/// Since the program began, of all its threads [s].
inline double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

} // namespace rubato
