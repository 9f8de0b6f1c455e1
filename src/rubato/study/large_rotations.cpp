// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/large_rotations.hpp"

namespace rubato::study {

/// Every strain is a small one.
bool takes_large_rotations(const Study& /*study*/) {
  return false;
}

} // namespace rubato::study
