// SPDX-License-Identifier: LGPL-3.0-or-later
/// Ctrl-C (SIGINT) and the polite request to end (SIGTERM).
#pragma once

#include <csignal>
#include <functional>
#include <stop_token>
#include <sys/types.h>

namespace rubato::app {

/// Both signals.
sigset_t interrupting_signals();

/// Blocks signals in this thread, and in those and the processes it starts, as long as it lives.
class BlockedSignals {
public:
  explicit BlockedSignals(const sigset_t& signals) { pthread_sigmask(SIG_BLOCK, &signals, &before_); }
  ~BlockedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  BlockedSignals(const BlockedSignals&) = delete;
  BlockedSignals& operator=(const BlockedSignals&) = delete;

private:
  sigset_t before_{};
};

/// Says that the work ends, when the signal comes from the keyboard.
void print_stopping(int signal);

/// Ends the program as the signal does when nobody cares for it.
void die_of(int signal);

/// Does `work` and returns what it returns; exceptions pass. The first of these signals only asks for a stop
/// by the token; the second one kills the program at once.
///
/// The work is done in a thread of its own while the first thread waits for signals: METIS catches SIGTERM
/// while it orders a matrix and would leave by a long jump, so no handler may ever see one.
int run_interruptibly(const std::function<int(const std::stop_token&)>& work);

/// The same in a process that the process `starter` answers for: a Ctrl-C is for that one, and further
/// signals after the first one do nothing.
int run_interruptibly(const std::function<int(const std::stop_token&)>& work, pid_t starter);

} // namespace rubato::app
