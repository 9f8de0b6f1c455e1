// SPDX-License-Identifier: LGPL-3.0-or-later
/// Structures of nonlinear bodies: Cook's membrane, tubes, beams, a bar that necks (bulk_benchmarks.hpp).
#pragma once

#include "verification/bulk_benchmarks.hpp"
#include <vector>

namespace rubato::verification {

/// The same structures integrated in full: by how much linear cells lock.
std::vector<Benchmark> locked_structures();
/// On meshes that take longer; those in full among them.
std::vector<Benchmark> finer_structures();

} // namespace rubato::verification
