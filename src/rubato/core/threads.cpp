// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/threads.hpp"

#include <algorithm>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace rubato {

/// Made when it is first needed: oneTBB takes milliseconds to look at the machine, as long as a small study.
struct Threads::Arena {
  explicit Arena(int count) : count_(count) {}

  tbb::task_arena& get() {
    std::call_once(once_, [this] {
      allowed_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_));
      arena_.emplace(count_);
    });
    return *arena_;
  }

private:
  int count_;
  std::once_flag once_;
  std::optional<tbb::global_control> allowed_; ///< else there are no more than processors
  std::optional<tbb::task_arena> arena_;
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
  arena_->get().execute([&] { tbb::parallel_for(0, parts, work, tbb::simple_partitioner()); });
}

void Threads::each_range(std::size_t pieces, std::size_t smallest,
                         const std::function<void(std::size_t, std::size_t)>& work) const {
  const auto parts = static_cast<std::size_t>(parts_of(pieces, smallest));
  each(static_cast<int>(parts), [&](int number) {
    const auto part = static_cast<std::size_t>(number);
    work(pieces * part / parts, pieces * (part + 1) / parts);
  });
}

} // namespace rubato
