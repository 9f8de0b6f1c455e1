// SPDX-License-Identifier: LGPL-3.0-or-later
/// A run beside others as the program that starts it sees it.
#pragma once

#include "rubato/linalg/memory.hpp"
#include "rubato/run/memory_beside.hpp"
#include "rubato/study/study.hpp"

#include "child_process.hpp"
#include "run_channel.hpp"
#include "shared_stream.hpp"
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::app {

struct Job {
  const study::Study* study = nullptr;
  std::vector<std::size_t> after;    ///< numbers of runs that must have ended before
  std::optional<std::size_t> source; ///< the one of them that it starts from

  std::unique_ptr<ChildProcess> process; ///< while it runs
  Lines lines;                           ///< of its standard error
  std::string results;                   ///< of its standard output
  std::optional<RunMessage> progress;    ///< the last one
  std::optional<std::size_t> need;       ///< memory [bytes]: counted, before that what runs like it need
  std::size_t granted = 0;               ///< memory that it may have [bytes]
  std::size_t asked = 0;                 ///< memory that it waits for [bytes]
  bool told_to_wait = false;             ///< for memory
  bool came_to_its_end = false;          ///< its process did not break off

  bool ended = false; ///< or will not start any more
  bool complete = false;

  const std::string& name() const { return study->name; }
  bool runs() const { return process != nullptr; }
  bool waits_for_memory() const { return asked > 0; }
  /// What it has of the memory; before it runs what its process will begin with.
  linalg::ProcessMemory memory() const;
};

/// One for each run.
std::vector<Job> jobs_of(std::span<const study::Study> runs);

/// Of all jobs that run but `but`.
std::vector<run::MemoryOfRun> memory_of_others(std::span<const Job> jobs, const Job& but);

/// What may be taken beside the other jobs that run [bytes].
std::size_t memory_left_for(const Job& job, std::span<const Job> jobs);

/// What a job is expected to need, as others do that are like it [bytes]; nothing where there are none.
std::optional<std::size_t> expected_need(const Job& job, std::span<const Job> jobs);

} // namespace rubato::app
