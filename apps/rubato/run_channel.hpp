// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a run beside others tells the program that started it, and the one answer that it waits for.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

namespace rubato::app {

struct RunMessage {
  enum class Kind {
    progress,
    memory, ///< `bytes` are about to be taken, and an answer is waited for; 0: all that is counted is taken
    ended   ///< the run, however it did; without it the process broke off
  };
  Kind kind = Kind::progress;
  double part = 0;    ///< of the run that is done
  double seconds = 0; ///< since its first step began
  std::size_t bytes = 0;
};

/// Sends a message, to whoever is still there.
void send(int channel, const RunMessage& message);
/// Waits for one. Nothing at the end of the channel.
std::optional<RunMessage> received(int channel);

/// Answers whoever waits for memory.
void grant(int channel);
/// Waits for that answer. False when `stop` says so meanwhile, and at the end of the channel.
bool is_granted(int channel, const std::function<bool()>& stop);

} // namespace rubato::app
