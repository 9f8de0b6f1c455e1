// SPDX-License-Identifier: LGPL-3.0-or-later
#include "progress.hpp"

#include "rubato/run/progress_text.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <sys/ioctl.h>
#include <unistd.h>

namespace rubato::app {

std::size_t terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

ProgressLine::ProgressLine(bool quiet)
    : quiet_(quiet), terminal_(isatty(fileno(stderr)) != 0), pace_(terminal_) {}

void ProgressLine::update(const run::Progress& progress) {
  const auto now = Clock::now();
  if (quiet_ || !pace_.is_due(progress, now))
    return;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  if (terminal_)
    fmt::print(stderr, "\r\033[K{}", run::terminal_line(progress, seconds, terminal_columns()));
  else
    fmt::print(stderr, "{}\n", run::plain_line(progress, seconds));
  std::fflush(stderr);
  open_ = terminal_;
}

void ProgressLine::say(const std::string& text) {
  close();
  start_ = Clock::now();
  pace_.begin(start_);
  if (!quiet_)
    fmt::print(stderr, "{}\n", text);
}

void ProgressLine::warn(const std::string& text) {
  close();
  fmt::print(stderr, "warning: {}\n", text);
}

void ProgressLine::close() {
  if (open_)
    fmt::print(stderr, "\n");
  open_ = false;
}

} // namespace rubato::app
