// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/threads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sched.h>
#include <set>
#include <string>
#include <thread>

namespace rubato {
namespace {

/// Processors that the process may run on, those of one core once.
int allowed_cores() {
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) != 0)
    return static_cast<int>(std::thread::hardware_concurrency());
  std::set<std::string> cores;
  for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (!CPU_ISSET(processor, &allowed))
      continue;
    std::string siblings = std::to_string(processor);
    std::ifstream file(fmt::format("/sys/devices/system/cpu/cpu{}/topology/thread_siblings_list", processor));
    std::getline(file, siblings);
    cores.insert(siblings.empty() ? std::to_string(processor) : siblings);
  }
  return static_cast<int>(cores.size());
}

/// What a container may use, of its control group; without a limit as many as there are.
int cores_of_group() {
  std::ifstream file("/sys/fs/cgroup/cpu.max");
  double quota = 0, period = 0;
  constexpr int unlimited = CPU_SETSIZE;
  if (!(file >> quota >> period) || !(quota > 0) || !(period > 0))
    return unlimited;
  return std::max(1, static_cast<int>(std::floor(quota / period)));
}

} // namespace

int physical_cores() {
  return std::clamp(allowed_cores(), 1, cores_of_group());
}

} // namespace rubato
