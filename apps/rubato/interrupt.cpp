// SPDX-License-Identifier: LGPL-3.0-or-later
#include "interrupt.hpp"

#include <csignal>
#include <string_view>
#include <unistd.h>

namespace rubato::app {
namespace {

// A signal handler can reach nothing else.
volatile std::sig_atomic_t interrupted = 0;

extern "C" void on_interrupt(int signal) {
  interrupted = 1;
  if (signal != SIGINT)
    return;
  constexpr std::string_view text = "\nstopping after this step; Ctrl-C again stops at once\n";
  // Nothing can be done about a failure here; the compiler wants to see the result looked at.
  if (write(STDERR_FILENO, text.data(), text.size()) < 0)
    return;
}

} // namespace

void catch_interrupts() {
  struct sigaction action = {};
  action.sa_handler = on_interrupt;
  // After the first one the system's own handling is back, and that ends the program.
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

bool is_interrupted() {
  return interrupted != 0;
}

} // namespace rubato::app
