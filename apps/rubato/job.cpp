// SPDX-License-Identifier: LGPL-3.0-or-later
#include "job.hpp"

#include <algorithm>
#include <unistd.h>

namespace rubato::app {

linalg::ProcessMemory Job::memory() const {
  return linalg::memory_of_process(process ? process->id() : getpid());
}

std::vector<Job> jobs_of(std::span<const study::Study> runs) {
  std::vector<Job> jobs(runs.size());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    auto& job = jobs[i];
    job.study = &runs[i];
    const auto number_of = [&](const std::string& name) {
      const auto found = std::ranges::find(runs, name, &study::Study::name);
      return found == runs.end() ? std::nullopt : std::optional<std::size_t>(found - runs.begin());
    };
    job.source = number_of(runs[i].time.start_run);
    if (job.source)
      job.after.push_back(*job.source);
    for (const auto& check : runs[i].checks)
      if (const auto other = number_of(check.run))
        job.after.push_back(*other);
  }
  return jobs;
}

std::vector<run::MemoryOfRun> memory_of_others(std::span<const Job> jobs, const Job& but) {
  std::vector<run::MemoryOfRun> others;
  for (const auto& job : jobs)
    if (job.runs() && &job != &but) {
      const auto now = job.memory();
      const auto taken = now.resident;
      others.push_back({job.waits_for_memory() ? taken : job.need.value_or(taken), taken, now.address_space});
    }
  return others;
}

std::size_t memory_left_for(const Job& job, std::span<const Job> jobs) {
  return run::memory_left(job.memory().address_space, memory_of_others(jobs, job),
                          {linalg::free_memory(), linalg::memory_limit()});
}

std::optional<std::size_t> expected_need(const Job& job, std::span<const Job> jobs) {
  std::optional<std::size_t> need;
  for (const auto& other : jobs)
    if (&other != &job && other.need && run::need_alike(*other.study, *job.study))
      need = std::max(need.value_or(0), *other.need);
  return need;
}

} // namespace rubato::app
