// SPDX-License-Identifier: LGPL-3.0-or-later
/// A run beside others, in the process of its own.
#pragma once

#include "rubato/deck/read.hpp"

#include "run_one.hpp"
#include <cstddef>
#include <filesystem>
#include <sys/types.h>

namespace rubato::app {

struct RunBeside {
  const deck::Deck& deck;
  std::size_t number; ///< of the run in the deck
  const RunSettings& settings;
  std::filesystem::path start; ///< file of the state that it starts from; empty: none
  std::filesystem::path end;   ///< file for its last state, where its checkpoint does not have it
  bool terminal = false;       ///< progress goes to the channel
  pid_t starter = 0;           ///< the process that answers
};

/// Runs it; the value is its exit code. Memory is asked for by `channel` before it is taken.
int run_beside(const RunBeside& run, int channel);

} // namespace rubato::app
