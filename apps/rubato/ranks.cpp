// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ranks.hpp"

#include "rubato/core/channel.hpp"
#include "rubato/core/error.hpp"
#include "rubato/linalg/petsc_module.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <string>
#include <unistd.h>

namespace rubato::app {
namespace {

/// Where errors go; a duplicate once this rank is hushed.
int errors = STDERR_FILENO;

/// How a part ended.
struct Ending {
  int code = done;
  std::string text;
  double patience = 5; ///< how long others may take to end too [s]
};

Ending ending_of(const std::exception_ptr& error) {
  /// All ranks read the same files, some of them later.
  constexpr double while_reading = 30;
  try {
    std::rethrow_exception(error);
  } catch (const InputError& refused) {
    return {bad_input, refused.what(), while_reading};
  } catch (const std::exception& failed) {
    return {other_failure, failed.what()};
  }
}

} // namespace

void hush_other_ranks() {
  if (linalg::started_index() == 0)
    return;
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  errors = dup(STDERR_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

int together(const Ranks& ranks, const std::function<int()>& part) {
  if (!ranks.channel())
    return part();
  Ending ending;
  std::exception_ptr error;
  try {
    ending.code = part();
  } catch (...) {
    error = std::current_exception();
    ending = ending_of(error);
  }
  if (!ranks.channel()->all_leave(ending.patience)) {
    const auto text = fmt::format("error: rank {} of {} ended alone: {}\n", ranks.index(), ranks.count(),
                                  ending.text.empty() ? "its part was done" : ending.text);
    if (write(errors, text.data(), text.size()) < 0)
      std::fputs("error: a rank ended alone\n", stderr);
    ranks.channel()->abort(ending.code == done ? other_failure : ending.code);
  }
  if (error)
    std::rethrow_exception(error);
  return ending.code;
}

} // namespace rubato::app
