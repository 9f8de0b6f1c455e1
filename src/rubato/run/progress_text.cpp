// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/progress_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::run {
namespace {

constexpr std::size_t widest_bar = 24;
constexpr std::size_t narrowest_bar = 6;

std::string bar(double part, std::size_t width) {
  const auto full = std::min(width, static_cast<std::size_t>(part * static_cast<double>(width)));
  return fmt::format(" [{}{}]", std::string(full, '#'), std::string(width - full, '.'));
}

std::string left_text(double part, double seconds) {
  return part > 0 ? "  left " + duration_text(seconds * (1 - part) / part) : "";
}

/// What stands between the bar and the time left. The pieces that may go are listed in `may_go`, the first to
/// go first.
struct Pieces {
  std::vector<std::string> texts;
  std::vector<std::size_t> may_go;

  std::string joined() const { return fmt::format("{}", fmt::join(texts, "")); }
};

Pieces pieces_of(const Progress& p) {
  Pieces pieces{{fmt::format(" t = {:.6g}", p.t), fmt::format("  h = {:.3g}", p.step),
                 p.accepted || p.within ? "" : " (failed, cut)", fmt::format("  iterations {}", p.iterations),
                 fmt::format("  in contact {}", p.contact_points)},
                {1, 4, 3, 2}};
  if (p.within && std::isfinite(p.residual)) {
    pieces.texts.push_back(fmt::format("  residual {:.1e}", p.residual));
    pieces.may_go = {1, 4, 5, 3, 2};
  }
  return pieces;
}

std::string text_of(const RunPart& run, std::size_t longest_name, bool with_time) {
  const auto name = std::string_view(run.name).substr(0, longest_name);
  if (!run.begun)
    return fmt::format("{} set-up", name);
  return fmt::format("{} {:.0f} %{}", name, 100 * run.part,
                     with_time ? left_text(run.part, run.seconds) : "");
}

std::string text_of(std::span<const RunPart> runs, std::size_t waiting, std::size_t longest_name,
                    bool with_time) {
  std::vector<std::string> texts;
  for (const auto& run : runs)
    texts.push_back(text_of(run, longest_name, with_time));
  if (waiting > 0)
    texts.push_back(fmt::format("{} to come", waiting));
  return fmt::format("{}", fmt::join(texts, " | "));
}

} // namespace

double part_done(const Progress& p) {
  const double reached = p.accepted ? p.t : p.t - p.step;
  return std::clamp((reached - p.begin) / (p.end - p.begin), 0.0, 1.0);
}

bool Pace::is_due(const Progress& progress, Clock::time_point now) {
  using std::chrono::milliseconds;
  const auto to_next = now - std::exchange(heard_, now);
  const bool last = progress.accepted && progress.t >= progress.end;
  const bool failed = !progress.accepted && !progress.within;
  bool due = last || failed;
  if (terminal_)
    due = due || now - last_ >= milliseconds(50);
  else if (progress.within)
    due = now - last_ + to_next > std::chrono::seconds(5);
  else
    due = due || !shown_ || now - last_ >= std::chrono::seconds(1);
  if (due)
    last_ = now;
  shown_ = shown_ || due;
  return due;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long>(std::min(seconds, 1e9));
  if (whole < 60)
    return fmt::format("{} s", whole);
  if (whole < 3600)
    return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string terminal_line(const Progress& progress, double seconds, std::size_t columns) {
  constexpr std::size_t around_bar = 3;
  const std::size_t room = std::max<std::size_t>(columns, 1) - 1;
  const double part = part_done(progress);
  const auto left = left_text(part, seconds);
  auto pieces = pieces_of(progress);
  std::string name(progress.run);
  const auto without_bar = [&] { return name.size() + pieces.joined().size() + left.size(); };
  for (const auto piece : pieces.may_go)
    if (without_bar() + around_bar + narrowest_bar > room)
      pieces.texts[piece].clear();
  const auto others = without_bar() + around_bar;
  const auto width = others + narrowest_bar <= room ? std::min(widest_bar, room - others) : 0;
  if (width == 0 && without_bar() > room)
    name.resize(name.size() - std::min(name.size(), without_bar() - room));
  return (name + (width > 0 ? bar(part, width) : "") + pieces.joined() + left).substr(0, room);
}

std::string terminal_line(std::span<const RunPart> runs, std::size_t waiting, std::size_t columns) {
  const std::size_t room = std::max<std::size_t>(columns, 1) - 1;
  std::size_t longest = 0;
  for (const auto& run : runs)
    longest = std::max(longest, run.name.size());
  auto text = text_of(runs, waiting, longest, true);
  for (; text.size() > room && longest > 0; --longest)
    text = text_of(runs, waiting, longest, false);
  return text.substr(0, room);
}

std::string plain_line(const Progress& progress, double seconds) {
  const double part = part_done(progress);
  return fmt::format("{} {:3.0f} %{}{}", progress.run, 100 * part, pieces_of(progress).joined(),
                     left_text(part, seconds));
}

} // namespace rubato::run
