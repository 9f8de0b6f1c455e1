// SPDX-License-Identifier: LGPL-3.0-or-later
/// How many processes work on one run, and how they agree.
///
/// All ranks go through the same calls with the same numbers. What only one of them can know, as whether a
/// file could be written, is told to all before anything follows from it.
#pragma once

#include "rubato/core/threads.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace rubato {

class Channel;

/// A value: copies stand for the same ranks. By default there is one, and all calls are free.
class Ranks {
public:
  Ranks() = default;
  explicit Ranks(std::shared_ptr<Channel> channel);

  int index() const { return index_; }
  int count() const { return count_; }
  /// On this machine.
  int count_here() const;
  bool is_first() const { return index() == 0; }
  bool is_alone() const { return count() == 1; }

  // What the first rank has.
  bool of_first(bool own) const { return of_first(own ? 1 : 0) != 0; }
  int of_first(int own) const;
  void share_first(std::span<double> values) const;
  /// Whether it is so on all ranks.
  bool all(bool own) const;
  // Σ of the ranks, with the same bits on all.
  double sum(double own) const;
  void sum(std::span<double> values) const;
  double largest(double own) const;
  // What each rank has, in their order; all of them have as many numbers.
  template <class Number> std::vector<Number> each(Number own) const {
    return each_of(std::span<const Number>(&own, 1));
  }
  template <class Number> std::vector<Number> each_of(std::span<const Number> own) const {
    std::vector<Number> all(own.size() * static_cast<std::size_t>(count_));
    gather(std::as_bytes(own), std::as_writable_bytes(std::span(all)));
    return all;
  }
  /// Goes on once all are here.
  void meet() const { all(true); }

  /// By all ranks together to one another, so far (Channel::bytes_sent); what solvers send is not in it.
  double bytes_sent() const;

  /// The first rank does it and the others wait. What it throws is thrown by all: InputError, WriteError and
  /// std::bad_alloc as such, else std::runtime_error.
  void first_does(const std::function<void()>& work) const;

  /// Null when alone.
  const std::shared_ptr<Channel>& channel() const { return channel_; }

private:
  void gather(std::span<const std::byte> own, std::span<std::byte> all) const;

  std::shared_ptr<Channel> channel_;
  int index_ = 0;
  int count_ = 1;
};

/// All that works on one run.
struct Workers {
  Workers() = default;
  Workers(Threads own, Ranks all = {}) : threads(std::move(own)), ranks(std::move(all)) {}
  Threads threads; ///< of each rank
  Ranks ranks;
};

} // namespace rubato
