// SPDX-License-Identifier: LGPL-3.0-or-later
#include "interrupt.hpp"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <future>

namespace rubato::app {
namespace {

/// How often the waiting thread looks whether the work is done.
constexpr timespec patience{.tv_sec = 0, .tv_nsec = 10'000'000};

sigset_t interrupting_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

/// Blocks signals in this thread, and in those it starts, as long as it lives.
class Blocked {
public:
  explicit Blocked(const sigset_t& signals) { pthread_sigmask(SIG_BLOCK, &signals, &before_); }
  ~Blocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Blocked(const Blocked&) = delete;
  Blocked& operator=(const Blocked&) = delete;

private:
  sigset_t before_{};
};

/// Ends the program as the signal does when nobody cares for it.
void die_of(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  std::raise(signal);
}

} // namespace

int run_interruptibly(const std::function<int(const std::stop_token&)>& work) {
  const auto signals = interrupting_signals();
  const Blocked blocked(signals);
  std::stop_source stop;
  auto result = std::async(std::launch::async, [&] { return work(stop.get_token()); });
  while (result.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    const int signal = sigtimedwait(&signals, nullptr, &patience);
    if (signal <= 0)
      continue;
    if (!stop.request_stop())
      die_of(signal);
    if (signal == SIGINT)
      fmt::print(stderr,
                 "\nstopping; a factorisation at hand comes to its end, Ctrl-C again stops at once\n");
  }
  return result.get();
}

} // namespace rubato::app
