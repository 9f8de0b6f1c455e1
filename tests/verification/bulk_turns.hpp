// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "verification/bulk_benchmarks.hpp"

namespace rubato::verification {

/// Row 29: blocks whose hulls turn rigidly by large angles, of every law, formulation and physics with large
/// strain. Nodes inside are free. The largest stress is to be rounding.
Benchmark rigid_turns();

} // namespace rubato::verification
