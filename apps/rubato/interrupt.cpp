// SPDX-License-Identifier: LGPL-3.0-or-later
#include "interrupt.hpp"

#include <fmt/format.h>

#include "child_process.hpp"
#include <chrono>
#include <cstdio>
#include <future>

namespace rubato::app {
namespace {

/// How often the waiting thread looks whether the work is done.
constexpr timespec patience{.tv_sec = 0, .tv_nsec = 10'000'000};

/// Does the work in another thread; `heard` gets each signal that comes meanwhile.
int run_listening(const std::function<int(const std::stop_token&)>& work,
                  const std::function<void(int, std::stop_source&)>& heard) {
  const auto signals = interrupting_signals();
  const BlockedSignals blocked(signals);
  std::stop_source stop;
  auto result = std::async(std::launch::async, [&] { return work(stop.get_token()); });
  while (result.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    if (const int signal = sigtimedwait(&signals, nullptr, &patience); signal > 0)
      heard(signal, stop);
  return result.get();
}

} // namespace

sigset_t interrupting_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void print_stopping(int signal) {
  if (signal == SIGINT)
    fmt::print(stderr, "\nstopping; a factorisation at hand comes to its end, Ctrl-C again stops at once\n");
}

void die_of(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t only;
  sigemptyset(&only);
  sigaddset(&only, signal);
  pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  std::raise(signal);
}

int run_interruptibly(const std::function<int(const std::stop_token&)>& work) {
  return run_listening(work, [](int signal, std::stop_source& stop) {
    if (!stop.request_stop())
      die_of(signal);
    print_stopping(signal);
  });
}

int run_interruptibly(const std::function<int(const std::stop_token&)>& work, pid_t starter) {
  return run_listening(work, [starter](int signal, std::stop_source& stop) {
    if (signal != SIGTERM)
      return;
    is_left_alone(starter);
    stop.request_stop();
  });
}

} // namespace rubato::app
