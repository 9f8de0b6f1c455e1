// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/memory_beside.hpp"

#include "rubato/study/schemes.hpp"

#include <algorithm>

namespace rubato::run {
namespace {

std::size_t less(std::size_t whole, std::size_t part) {
  return whole > part ? whole - part : 0;
}

} // namespace

std::size_t memory_left(std::size_t address_space, std::span<const MemoryOfRun> others,
                        const MemoryForRuns& memory) {
  auto free = memory.free;
  auto below_limit = less(memory.limit, address_space);
  for (const auto& other : others) {
    const auto to_come = less(other.need, other.taken);
    free = less(free, to_come);
    below_limit = less(below_limit, other.address_space + to_come);
  }
  return std::min(free, below_limit);
}

bool need_alike(const study::Study& a, const study::Study& b) {
  return a.mesh == b.mesh && a.physics == b.physics && a.solver == b.solver &&
         study::is_explicit(a.time.scheme) == study::is_explicit(b.time.scheme);
}

} // namespace rubato::run
