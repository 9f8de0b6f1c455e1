// SPDX-License-Identifier: LGPL-3.0-or-later
#include "run_beside.hpp"

#include "rubato/results/checkpoint.hpp"
#include "rubato/run/progress_text.hpp"

#include <fmt/format.h>

#include "interrupt.hpp"
#include "run_channel.hpp"
#include <chrono>
#include <optional>

namespace rubato::app {
namespace {

/// Tells a progress to the program that shows that of all runs.
class ProgressTeller {
public:
  explicit ProgressTeller(int channel) : channel_(channel) {}

  void begin() { begin_ = Clock::now(); }

  void tell(const run::Progress& progress) {
    const auto now = Clock::now();
    if (now - last_ < pace && progress.t < progress.end)
      return;
    last_ = now;
    send(channel_, {.kind = RunMessage::Kind::progress,
                    .part = run::part_done(progress),
                    .seconds = std::chrono::duration<double>(now - begin_).count()});
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds pace{100};

  int channel_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point last_{};
};

/// Asks for memory and waits until there is some.
void ask_for(std::size_t bytes, int channel, const std::function<bool()>& stop) {
  send(channel, {.kind = RunMessage::Kind::memory, .bytes = bytes});
  if (bytes > 0 && !is_granted(channel, stop))
    throw run::StoppedWhileWaiting();
}

std::optional<step::State> state_in(const std::filesystem::path& file) {
  if (file.empty())
    return std::nullopt;
  return std::move(results::read_checkpoint(file).memento.state);
}

void keep(step::State state, const std::filesystem::path& file) {
  results::Checkpoint end;
  end.memento.state = std::move(state);
  results::write_checkpoint(file, std::move(end));
}

int run_to_its_end(const RunBeside& run, int channel, const std::stop_token& stop) {
  const auto& study = run.deck.runs[run.number];
  ProgressLine line(run.settings.quiet);
  auto watch = watch_of(line);
  watch.stop = [&] { return stop.stop_requested(); };
  watch.room = [&](std::size_t bytes) { ask_for(bytes, channel, watch.stop); };
  ProgressTeller teller(channel);
  if (run.terminal) {
    watch.progress = [&](const run::Progress& progress) { teller.tell(progress); };
    watch.within = watch.progress;
    watch.say = [&](const std::string& text) {
      teller.begin();
      line.say(text);
    };
  }
  try {
    const auto previous = state_in(run.start);
    auto end = run_one(study, run.settings, watch, line, previous ? &*previous : nullptr);
    if (end.complete && !end.kept && !run.end.empty())
      keep(std::move(end.state), run.end);
    send(channel, {.kind = RunMessage::Kind::ended});
    return end.code;
  } catch (const InputError& error) {
    throw run.deck.places[run.number].located(error);
  } catch (const run::StoppedWhileWaiting&) {
    fmt::print(stderr, "error: {}: interrupted before its first step, nothing was written\n", study.name);
    return other_failure;
  }
}

} // namespace

int run_beside(const RunBeside& run, int channel) {
  return run_interruptibly([&](const std::stop_token& stop) { return run_to_its_end(run, channel, stop); },
                           run.starter);
}

} // namespace rubato::app
