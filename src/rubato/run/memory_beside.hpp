// SPDX-License-Identifier: LGPL-3.0-or-later
/// Memory of runs that are computed at once, counted before it is taken.
#pragma once

#include "rubato/study/study.hpp"

#include <cstddef>
#include <span>

namespace rubato::run {

/// Of one run [bytes].
struct MemoryOfRun {
  std::size_t need = 0;  ///< all it will have, as counted so far
  std::size_t taken = 0; ///< what it has now
  std::size_t address_space = 0;
};

/// What all of them may have [bytes].
struct MemoryForRuns {
  std::size_t free = 0;  ///< now: nobody has taken it
  std::size_t limit = 0; ///< of the address space of all runs together
};

/// What a run of that address space may take beside the others [bytes]: they may have taken less than they
/// need, and the rest of that is theirs.
std::size_t memory_left(std::size_t address_space, std::span<const MemoryOfRun> others,
                        const MemoryForRuns& memory);

/// Whether a run is expected to need what the other one does: mesh, physics, and how steps are solved.
bool need_alike(const study::Study& a, const study::Study& b);

} // namespace rubato::run
