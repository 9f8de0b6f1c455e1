// SPDX-License-Identifier: LGPL-3.0-or-later
#include "side_by_side.hpp"

#include "rubato/linalg/memory.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/run/progress_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "interrupt.hpp"
#include "job.hpp"
#include "run_beside.hpp"
#include <algorithm>
#include <array>
#include <cstring>
#include <poll.h>
#include <stdexcept>
#include <sys/signalfd.h>
#include <unistd.h>

namespace rubato::app {
namespace {

namespace fs = std::filesystem;

/// How often memory is looked at, and the line of a terminal is written.
constexpr int refresh_in_milliseconds = 250;

/// What is there to read now; nothing at the end.
std::string read_some(int descriptor) {
  std::array<char, 65536> room{};
  const auto count = read(descriptor, room.data(), room.size());
  return {room.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
}

/// A folder of its own for last states that no checkpoint has. It goes with this.
class PlaceForEnds {
public:
  PlaceForEnds() = default;
  ~PlaceForEnds() {
    std::error_code ignored;
    if (!folder_.empty())
      fs::remove_all(folder_, ignored);
  }
  PlaceForEnds(const PlaceForEnds&) = delete;
  PlaceForEnds& operator=(const PlaceForEnds&) = delete;

  fs::path file_for(const std::string& run) {
    if (folder_.empty())
      make();
    return folder_ / (run + ".h5");
  }

private:
  void make() {
    auto name = (fs::temp_directory_path() / "rubato-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error(fmt::format("{}: no folder can be made there for the ends of runs",
                                           fs::temp_directory_path().string()));
    folder_ = name;
  }

  fs::path folder_;
};

class SideBySide {
public:
  SideBySide(const deck::Deck& deck, const RunSettings& settings, int jobs)
      : deck_(deck), settings_(settings), most_(jobs), jobs_(jobs_of(deck.runs)), stream_(settings.quiet),
        signals_(signalfd(-1, &interrupting_, SFD_CLOEXEC)) {}

  int run() {
    start_what_can();
    while (running() > 0) {
      listen();
      grant_memory();
      start_what_can();
      show();
    }
    stream_.clear();
    return worst_;
  }

private:
  // ---- starting ----

  std::ptrdiff_t running() const { return std::ranges::count_if(jobs_, &Job::runs); }

  /// Runs come after those that they wait for.
  void start_what_can() {
    for (auto& job : jobs_) {
      if (stopping_ || broken_ || job.ended || job.runs() ||
          !std::ranges::all_of(job.after, [&](auto number) { return jobs_[number].ended; }))
        continue;
      if (job.source && !jobs_[*job.source].complete)
        leave_out(job);
      else if (running() < most_ && has_room(job))
        start(job);
    }
  }

  void leave_out(Job& job) {
    stream_.clear();
    print_not_run(*job.study);
    job.ended = true;
  }

  /// Whether a run may start beside those that run. What they need must be known.
  bool has_room(Job& job) {
    if (running() == 0)
      return true;
    if (std::ranges::any_of(jobs_, [](const Job& other) { return other.runs() && !other.need; }))
      return false;
    const auto need = expected_need(job, jobs_).value_or(0);
    const auto left = memory_left_for(job, jobs_);
    if (need > left)
      tell_to_wait(job, fmt::format("it needs {}, as runs like it do", linalg::memory_text(need)), left);
    return need <= left;
  }

  void start(Job& job) {
    const auto number = static_cast<std::size_t>(&job - jobs_.data());
    const bool has_next = std::ranges::any_of(jobs_, [&](const Job& next) { return next.source == number; });
    const RunBeside run{.deck = deck_,
                        .number = number,
                        .settings = settings_,
                        .start = job.source ? end_of(*job.source) : fs::path(),
                        .end = has_next ? ends_.file_for(job.name()) : fs::path(),
                        .terminal = stream_.has_status(),
                        .starter = getpid()};
    job.need = expected_need(job, jobs_);
    job.process = std::make_unique<ChildProcess>([&](int channel) { return run_beside(run, channel); });
  }

  /// The file that has the last state of a run.
  fs::path end_of(std::size_t number) {
    const auto& name = jobs_[number].name();
    if (auto file = ends_.file_for(name); fs::exists(file))
      return file;
    return settings_.output / name / results::checkpoint_file;
  }

  // ---- memory ----

  /// Where all wait for memory, the first one goes on: it refuses by itself what does not fit.
  void grant_memory() {
    for (auto& job : jobs_) {
      if (stopping_ || !job.runs() || !job.waits_for_memory())
        continue;
      const bool alone = std::ranges::all_of(
          jobs_, [](const Job& other) { return !other.runs() || other.waits_for_memory(); });
      const auto left = memory_left_for(job, jobs_);
      if (alone || job.asked <= left)
        grant_to(job);
      else
        tell_to_wait(job, fmt::format("the factor of its matrix needs {}", linalg::memory_text(job.asked)),
                     left);
    }
  }

  static void grant_to(Job& job) {
    job.granted = std::max(job.granted, job.memory().resident + job.asked);
    job.need = job.granted;
    job.asked = 0;
    grant(job.process->channel().number());
  }

  /// Once a run.
  void tell_to_wait(Job& job, const std::string& wants, std::size_t left) {
    if (std::exchange(job.told_to_wait, true) || settings_.quiet)
      return;
    std::vector<std::string> others;
    for (const auto& other : jobs_)
      if (other.runs() && &other != &job)
        others.push_back(other.name());
    stream_.print(fmt::format("{}: waits for memory: {}, and {} are left beside {}\n", job.name(), wants,
                              linalg::memory_text(left), fmt::join(others, ", ")));
  }

  // ---- listening ----

  void listen() {
    std::vector<pollfd> open{{signals_.number(), POLLIN, 0}};
    for (auto& job : jobs_)
      if (job.runs())
        for (const auto* end : {&job.process->out(), &job.process->err(), &job.process->channel()})
          open.push_back({end->number(), POLLIN, 0}); // those that are closed are left out by poll
    if (poll(open.data(), open.size(), refresh_in_milliseconds) <= 0)
      return;
    if (open.front().revents != 0)
      hear_signal();
    std::size_t next = 1;
    for (auto& job : jobs_)
      if (job.runs()) {
        hear(job, {open[next].revents != 0, open[next + 1].revents != 0, open[next + 2].revents != 0});
        next += 3;
      }
  }

  /// Which of a job's ends have something.
  struct Heard {
    bool out, err, channel;
  };

  void hear(Job& job, const Heard& heard) {
    auto& process = *job.process;
    if (heard.out) {
      const auto text = read_some(process.out().number());
      job.results += text;
      if (text.empty())
        process.out().close();
    }
    if (heard.err) {
      const auto text = read_some(process.err().number());
      stream_.print(job.lines.add(text));
      if (text.empty())
        process.err().close();
    }
    if (heard.channel)
      hear_message(job);
    if (process.out().number() < 0 && process.err().number() < 0 && process.channel().number() < 0)
      finish(job);
  }

  static void hear_message(Job& job) {
    const auto message = received(job.process->channel().number());
    if (!message)
      return job.process->channel().close();
    switch (message->kind) {
    case RunMessage::Kind::progress:
      job.progress = message;
      break;
    case RunMessage::Kind::memory:
      job.asked = message->bytes;
      if (job.asked == 0)
        job.need = std::max(job.granted, job.memory().resident);
      break;
    case RunMessage::Kind::ended:
      job.came_to_its_end = true;
      break;
    }
  }

  /// The processes stop after what they are at. A second signal ends all at once.
  void hear_signal() {
    signalfd_siginfo heard{};
    if (read(signals_.number(), &heard, sizeof heard) != static_cast<ssize_t>(sizeof heard))
      return;
    const auto signal = static_cast<int>(heard.ssi_signo);
    stream_.clear();
    if (std::exchange(stopping_, true)) {
      jobs_.clear();
      die_of(signal);
    }
    print_stopping(signal);
    for (const auto& job : jobs_)
      if (job.runs())
        job.process->send(SIGTERM);
  }

  // ---- the end of a run ----

  void finish(Job& job) {
    const auto end = job.process->wait();
    job.process.reset();
    job.ended = true;
    job.complete = job.came_to_its_end && end.signal == 0 && end.code <= check_failed;
    stream_.print(job.lines.rest());
    stream_.print_result(job.results);
    if (end.signal != 0)
      print_killed(job, end.signal);
    else if (!job.came_to_its_end)
      broken_ = true;
    worst_ = std::max(worst_, end.signal != 0 ? static_cast<int>(other_failure) : end.code);
  }

  void print_killed(const Job& job, int signal) {
    stream_.print(fmt::format("error: {}: its process was ended by signal {} ({}){}; {}\n", job.name(),
                              signal, strsignal(signal),
                              signal == SIGKILL ? ", as the system does when memory runs out" : "",
                              left_in(settings_.output / job.name())));
  }

  /// What a run that was killed has left.
  static std::string left_in(const fs::path& folder) {
    if (!results::holds_run(folder))
      return "nothing was written";
    const bool kept = fs::exists(folder / results::checkpoint_file);
    return fmt::format("the results up to there are in {}{}", folder.string(),
                       kept ? ", --resume goes on from the last checkpoint" : "");
  }

  void show() {
    if (!stream_.has_status())
      return;
    std::vector<run::RunPart> parts;
    for (const auto& job : jobs_)
      if (job.runs())
        parts.push_back({job.name(), job.progress.has_value(), job.progress ? job.progress->part : 0,
                         job.progress ? job.progress->seconds : 0});
    const auto waiting =
        std::ranges::count_if(jobs_, [](const Job& job) { return !job.ended && !job.runs(); });
    stream_.show(run::terminal_line(parts, static_cast<std::size_t>(waiting), stream_.columns()));
  }

  const deck::Deck& deck_;
  const RunSettings& settings_;
  std::ptrdiff_t most_; ///< at once
  sigset_t interrupting_ = interrupting_signals();
  BlockedSignals blocked_{interrupting_};
  std::vector<Job> jobs_;
  SharedStream stream_;
  Descriptor signals_;
  PlaceForEnds ends_;
  bool stopping_ = false; ///< no other run starts: a signal came
  bool broken_ = false;   ///< no other run starts: one could not be run, as if the deck had a fault
  int worst_ = done;
};

} // namespace

int run_side_by_side(const deck::Deck& deck, const RunSettings& settings, int jobs) {
  return SideBySide(deck, settings, jobs).run();
}

} // namespace rubato::app
