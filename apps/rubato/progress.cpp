// SPDX-License-Identifier: LGPL-3.0-or-later
#include "progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace rubato::app {
namespace {

constexpr int bar_width = 24;

std::string bar(double part) {
  const int full = std::clamp(static_cast<int>(part * bar_width), 0, bar_width);
  return fmt::format("[{}{}]", std::string(static_cast<std::size_t>(full), '#'),
                     std::string(static_cast<std::size_t>(bar_width - full), '.'));
}

/// Columns of the terminal; a longer line would wrap and could not be rewritten.
std::size_t columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// "42 s", "3:07 min", "1:02:03 h"
std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::min(seconds, 1e9));
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

} // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(fileno(stderr)) != 0) {}

std::string ProgressLine::line_of(const run::Progress& p) const {
  const double reached = p.accepted ? p.t : p.t - p.step;
  const double part = (reached - p.begin) / (p.end - p.begin);
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  return fmt::format("{} {} t = {:.6g}  h = {:.3g}{}  iterations {}  in contact {}{}", p.run,
                     terminal_ ? bar(part) : fmt::format("{:3.0f} %", 100 * part), p.t, p.step,
                     p.accepted ? "" : " (failed, cut)", p.iterations, p.contact_points,
                     part > 0 ? "  left " + duration(seconds * (1 - part) / part) : "");
}

void ProgressLine::update(const run::Progress& progress) {
  if (quiet_)
    return;
  const auto now = Clock::now();
  const bool last = progress.accepted && progress.t >= progress.end;
  const auto pause = terminal_ ? std::chrono::milliseconds(50) : std::chrono::milliseconds(1000);
  if (!last && progress.accepted && now - last_ < pause)
    return;
  last_ = now;
  const auto line = line_of(progress);
  if (terminal_)
    fmt::print(stderr, "\r\033[K{}", std::string_view(line).substr(0, columns() - 1));
  else
    fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
  open_ = terminal_;
}

void ProgressLine::say(const std::string& text) {
  close();
  start_ = Clock::now();
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
