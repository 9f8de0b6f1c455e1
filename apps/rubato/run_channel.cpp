// SPDX-License-Identifier: LGPL-3.0-or-later
#include "run_channel.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <type_traits>

namespace rubato::app {
namespace {

static_assert(std::is_trivially_copyable_v<RunMessage>);

/// How often whoever waits for an answer looks whether to stop.
constexpr int patience_in_milliseconds = 50;
constexpr char granted = 'g';

} // namespace

void send(int channel, const RunMessage& message) {
  ::send(channel, &message, sizeof message, MSG_NOSIGNAL);
}

std::optional<RunMessage> received(int channel) {
  RunMessage message;
  if (recv(channel, &message, sizeof message, 0) != static_cast<ssize_t>(sizeof message))
    return std::nullopt;
  return message;
}

void grant(int channel) {
  ::send(channel, &granted, sizeof granted, MSG_NOSIGNAL);
}

bool is_granted(int channel, const std::function<bool()>& stop) {
  pollfd waiting{channel, POLLIN, 0};
  while (poll(&waiting, 1, patience_in_milliseconds) <= 0)
    if (stop())
      return false;
  char answer = 0;
  return recv(channel, &answer, sizeof answer, 0) == 1 && answer == granted;
}

} // namespace rubato::app
