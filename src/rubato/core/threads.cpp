// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/threads.hpp"

#include <algorithm>
#include <stdexcept>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rubato {

struct Threads::Arena {
  explicit Arena(int count)
      : allowed(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count)), arena(count) {
  }
  tbb::global_control allowed; ///< else there are no more than processors
  tbb::task_arena arena;
};

Threads::Threads(int count) : count_(count) {
  if (count < 1)
    throw std::invalid_argument("a run needs one thread at least");
  if (count > 1)
    arena_ = std::make_shared<Arena>(count);
}

int Threads::parts_of(std::size_t pieces, std::size_t smallest) const {
  return static_cast<int>(std::clamp<std::size_t>(pieces / smallest, 1, static_cast<std::size_t>(count_)));
}

void Threads::each(int parts, const std::function<void(int)>& work) const {
  if (arena_ == nullptr || parts < 2) {
    for (int part = 0; part < parts; ++part)
      work(part);
    return;
  }
  arena_->arena.execute([&] { tbb::parallel_for(0, parts, work, tbb::simple_partitioner()); });
}

} // namespace rubato
