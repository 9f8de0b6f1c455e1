// SPDX-License-Identifier: LGPL-3.0-or-later
/// Ranks as threads of one process: what several processes do, without them.
#pragma once

#include "rubato/core/channel.hpp"
#include "rubato/core/ranks.hpp"

#include <algorithm>
#include <barrier>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

namespace rubato::test {

/// Where they meet.
struct RankHub {
  explicit RankHub(int ranks)
      : barrier(ranks), given(static_cast<std::size_t>(ranks)), parcels(static_cast<std::size_t>(ranks)) {}
  std::barrier<> barrier;
  std::vector<std::span<const std::byte>> given;
  std::vector<std::span<Parcel>> parcels;
};

class ThreadChannel final : public Channel {
public:
  ThreadChannel(RankHub& hub, int index) : hub_(hub), index_(index) {}

  int index() const override { return index_; }
  int count() const override { return static_cast<int>(hub_.given.size()); }
  int count_here() const override { return count(); }
  std::uint64_t bytes_sent() const override { return sent_; }

  void broadcast(std::span<std::byte> data) override {
    together(data, [&] {
      if (index_ != 0)
        std::ranges::copy(hub_.given[0], data.begin());
    });
    sent_ += index_ == 0 ? data.size() : 0;
  }
  void gather(std::span<const std::byte> own, std::span<std::byte> all) override {
    together(own, [&] {
      auto* to = all.data();
      for (const auto part : hub_.given)
        to = std::ranges::copy(part, to).out;
    });
    sent_ += own.size();
  }
  void add_up(std::span<double> values) override {
    const auto own = std::vector<double>(values.begin(), values.end());
    together(std::as_bytes(std::span(own)), [&] {
      std::ranges::fill(values, 0.0);
      for (const auto part : hub_.given)
        if (part.size() != values.size_bytes())
          throw std::logic_error("ranks add up vectors of different sizes");
      for (const auto part : hub_.given)
        for (std::size_t i = 0; i < values.size(); ++i) {
          double value = 0;
          std::memcpy(&value, part.data() + sizeof(double) * i, sizeof(double));
          values[i] += value;
        }
    });
    sent_ += values.size_bytes();
  }
  void exchange(std::span<Parcel> parcels) override {
    hub_.parcels[static_cast<std::size_t>(index_)] = parcels;
    hub_.barrier.arrive_and_wait();
    for (auto& parcel : parcels) {
      const auto others = hub_.parcels[static_cast<std::size_t>(parcel.rank)];
      const auto from = std::ranges::find(others, index_, &Parcel::rank);
      if (from == others.end() || from->sent.size() != parcel.received.size())
        throw std::logic_error("a parcel that nobody sends");
      std::ranges::copy(from->sent, parcel.received.begin());
      sent_ += sizeof(double) * parcel.sent.size();
    }
    hub_.barrier.arrive_and_wait();
  }
  bool all_leave(double) override { return true; }
  void abort(int) override { std::terminate(); }

private:
  template <class Work> void together(std::span<const std::byte> own, const Work& work) {
    hub_.given[static_cast<std::size_t>(index_)] = own;
    hub_.barrier.arrive_and_wait();
    work();
    hub_.barrier.arrive_and_wait();
  }

  RankHub& hub_;
  int index_;
  std::uint64_t sent_ = 0;
};

/// Calls work(ranks) on as many threads, each a rank; throws what the first of them threw, if all threw
/// alike.
inline void as_ranks(int count, const std::function<void(const Ranks&)>& work) {
  RankHub hub(count);
  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(count));
  std::vector<std::jthread> threads;
  for (int index = 0; index < count; ++index)
    threads.emplace_back([&, index] {
      try {
        work(Ranks(std::make_shared<ThreadChannel>(hub, index)));
      } catch (...) {
        errors[static_cast<std::size_t>(index)] = std::current_exception();
      }
    });
  threads.clear();
  for (const auto& error : errors)
    if (error)
      std::rethrow_exception(error);
}

} // namespace rubato::test
