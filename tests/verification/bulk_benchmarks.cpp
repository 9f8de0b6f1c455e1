// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/bulk_benchmarks.hpp"

#include <cmath>

namespace rubato::verification {

bool BenchmarkNumber::within() const {
  return std::abs(found - expected) <= tolerance * std::abs(expected);
}

} // namespace rubato::verification
