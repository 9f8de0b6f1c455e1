// SPDX-License-Identifier: LGPL-3.0-or-later
/// Work on the surfaces of bodies that compliance does not couple, by threads.
#pragma once

#include "rubato/core/threads.hpp"

#include <cstddef>

namespace rubato::step {

/// Calls work(body) for each, side by side where there are so many `dofs` on them that threads wake up sooner
/// than one of them would be done with all.
template <class Work>
void for_each_body(const Threads& threads, std::size_t bodies, std::size_t dofs, const Work& work) {
  constexpr std::size_t fewest = 1000;
  if (dofs >= fewest)
    return threads.each(static_cast<int>(bodies), [&](int body) { work(static_cast<std::size_t>(body)); });
  for (std::size_t body = 0; body < bodies; ++body)
    work(body);
}

} // namespace rubato::step
