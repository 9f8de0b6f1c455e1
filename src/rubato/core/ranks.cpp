// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/ranks.hpp"

#include "rubato/core/channel.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rubato {
namespace {

/// How the work of the first rank ended.
enum class Ending : int { done, bad_input, not_written, no_memory, failed };

Ending ending_of(const std::exception_ptr& error) {
  if (!error)
    return Ending::done;
  try {
    std::rethrow_exception(error);
  } catch (const InputError&) {
    return Ending::bad_input;
  } catch (const WriteError&) {
    return Ending::not_written;
  } catch (const std::bad_alloc&) {
    return Ending::no_memory;
  } catch (...) {
    return Ending::failed;
  }
}

/// On another rank than the first, which tells the reason.
void follow(Ending ending) {
  switch (ending) {
  case Ending::done:
    return;
  case Ending::bad_input:
    throw InputError("the first rank refused its input");
  case Ending::not_written:
    throw WriteError("results of the first rank");
  case Ending::no_memory:
    throw std::bad_alloc();
  case Ending::failed:
    throw std::runtime_error("the first rank failed");
  }
}

} // namespace

Ranks::Ranks(std::shared_ptr<Channel> channel)
    : channel_(std::move(channel)), index_(channel_->index()), count_(channel_->count()) {}

int Ranks::count_here() const {
  return channel_ ? channel_->count_here() : 1;
}

int Ranks::of_first(int own) const {
  if (channel_)
    channel_->broadcast(std::as_writable_bytes(std::span(&own, 1)));
  return own;
}

void Ranks::share_first(std::span<double> values) const {
  if (channel_)
    channel_->broadcast(std::as_writable_bytes(values));
}

bool Ranks::all(bool own) const {
  return std::ranges::all_of(each(own ? 1 : 0), [](int one) { return one != 0; });
}

double Ranks::sum(double own) const {
  sum(std::span(&own, 1));
  return own;
}

void Ranks::sum(std::span<double> values) const {
  if (channel_)
    channel_->add_up(values);
}

double Ranks::largest(double own) const {
  return std::ranges::max(each(own));
}

void Ranks::gather(std::span<const std::byte> own, std::span<std::byte> all) const {
  if (channel_)
    channel_->gather(own, all);
  else
    std::ranges::copy(own, all.begin());
}

double Ranks::bytes_sent() const {
  return channel_ ? sum(static_cast<double>(channel_->bytes_sent())) : 0;
}

void Ranks::first_does(const std::function<void()>& work) const {
  if (!channel_)
    return work();
  std::exception_ptr error;
  if (is_first())
    try {
      work();
    } catch (...) {
      error = std::current_exception();
    }
  const auto ending = static_cast<Ending>(of_first(static_cast<int>(ending_of(error))));
  if (error)
    std::rethrow_exception(error);
  follow(ending);
}

} // namespace rubato
