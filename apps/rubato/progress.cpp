// SPDX-License-Identifier: LGPL-3.0-or-later
#include "progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <unistd.h>

namespace rubato::app {
namespace {

constexpr int bar_width = 24;

std::string bar(double part) {
  const int full = std::clamp(static_cast<int>(part * bar_width), 0, bar_width);
  return fmt::format("[{}{}]", std::string(static_cast<std::size_t>(full), '#'),
                     std::string(static_cast<std::size_t>(bar_width - full), '.'));
}

} // namespace

ProgressLine::ProgressLine(bool quiet) : quiet_(quiet), terminal_(isatty(fileno(stderr)) != 0) {}

std::string ProgressLine::line_of(const run::Progress& p) const {
  const double part = (p.t - p.begin) / (p.end - p.begin);
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  const double left = part > 0 ? seconds * (1 - part) / part : 0;
  return fmt::format("{} {} t = {:.6g}  h = {:.3g}{}  iterations {}  in contact {}  left {:.0f} s", p.run,
                     terminal_ ? bar(part) : fmt::format("{:3.0f} %", 100 * part), p.t, p.step,
                     p.accepted ? "" : " (failed, cut)", p.iterations, p.contact_points, left);
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
  fmt::print(stderr, "{}{}{}", terminal_ ? "\r\033[K" : "", line_of(progress), terminal_ ? "" : "\n");
  std::fflush(stderr);
  open_ = terminal_;
}

void ProgressLine::say(const std::string& text) {
  close();
  if (!quiet_)
    fmt::print(stderr, "{}\n", text);
}

void ProgressLine::close() {
  if (open_)
    fmt::print(stderr, "\n");
  open_ = false;
}

} // namespace rubato::app
