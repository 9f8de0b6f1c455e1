// SPDX-License-Identifier: LGPL-3.0-or-later
/// How many threads work on one run, and how work is dealt out to them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace rubato {

/// A value: copies stand for the same threads. By default there is one, the caller's, and no other is ever
/// started.
class Threads {
public:
  Threads() = default;
  /// Threads of oneTBB, which start when they are first needed and sleep between. Throws
  /// std::invalid_argument for less than one.
  explicit Threads(int count);

  int count() const { return count_; }
  /// How many parts pay: not more than threads, and each of at least `smallest` of the pieces; at least one.
  int parts_of(std::size_t pieces, std::size_t smallest) const;
  /// Calls work(part) once for each part from 0 on, at most count() of them at a time, and returns when all
  /// are done. What one of them throws is thrown here; others may then not have been called.
  void each(int parts, const std::function<void(int)>& work) const;
  /// Calls work(first, last) for as many ranges of the pieces as parts_of says, each from `first` to before
  /// `last`, as `each` does.
  void each_range(std::size_t pieces, std::size_t smallest,
                  const std::function<void(std::size_t, std::size_t)>& work) const;

private:
  struct Arena;
  int count_ = 1;
  std::shared_ptr<Arena> arena_; ///< null with one thread
};

/// Threads of this machine that have a core of their own, within what the process may use.
int physical_cores();

} // namespace rubato
