// SPDX-License-Identifier: LGPL-3.0-or-later
#include "shared_stream.hpp"

#include <fmt/format.h>

#include "progress.hpp"
#include <cstdio>
#include <unistd.h>
#include <utility>

namespace rubato::app {

std::string Lines::add(std::string_view text) {
  open_ += text;
  const auto end = open_.rfind('\n') + 1; // 0 without one
  auto whole = open_.substr(0, end);
  open_.erase(0, end);
  return whole;
}

std::string Lines::rest() {
  auto line = std::exchange(open_, {});
  return line.empty() ? line : line + "\n";
}

SharedStream::SharedStream(bool quiet) : quiet_(quiet), terminal_(isatty(fileno(stderr)) != 0) {}

std::size_t SharedStream::columns() const {
  return terminal_columns();
}

void SharedStream::print(std::string_view lines) {
  if (lines.empty())
    return;
  const auto status = std::exchange(status_, {});
  fmt::print(stderr, "{}{}{}", status.empty() ? "" : "\r\033[K", lines, status);
  std::fflush(stderr);
  status_ = status;
}

void SharedStream::print_result(std::string_view lines) {
  if (lines.empty())
    return;
  auto status = status_;
  clear();
  fmt::print("{}", lines);
  std::fflush(stdout);
  show(std::move(status));
}

void SharedStream::show(std::string status) {
  if (!has_status() || status == status_)
    return;
  fmt::print(stderr, "\r\033[K{}", status);
  std::fflush(stderr);
  status_ = std::move(status);
}

void SharedStream::clear() {
  if (!status_.empty())
    fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  status_.clear();
}

} // namespace rubato::app
