// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/memory.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <sys/resource.h>
#include <unistd.h>

namespace rubato::linalg {
namespace {

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

std::size_t left_of(std::size_t limit, std::size_t used) {
  return limit > used ? limit - used : 0;
}

std::size_t left_to_the_system() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  std::size_t kibibytes = 0;
  std::string unit;
  while (file >> name >> kibibytes && std::getline(file, unit))
    if (name == "MemAvailable:")
      return kibibytes * 1024;
  return unlimited;
}

/// A file that holds one number, or "max".
std::size_t number_in(const std::string& path) {
  std::ifstream file(path);
  std::size_t number = unlimited;
  return file >> number ? number : unlimited;
}

/// Of the group that a container's root shows; its own files count what it can free as used, so this is low
/// rather than high.
std::size_t left_to_the_group() {
  const auto limit = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  return limit == unlimited || used == unlimited ? unlimited : left_of(limit, used);
}

std::size_t page_size() {
  return static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::size_t left_to_the_process() {
  const auto limit = memory_limit();
  const auto pages = limit == unlimited ? unlimited : number_in("/proc/self/statm");
  return pages == unlimited ? unlimited : left_of(limit, pages * page_size());
}

double in_gigabytes(std::size_t bytes) {
  return static_cast<double>(bytes) / 1e9;
}

std::string two_digits(double number, const char* unit) {
  return number < 10 ? fmt::format("{:.1f} {}", number, unit) : fmt::format("{:.0f} {}", number, unit);
}

} // namespace

std::size_t available_memory() {
  return std::min(free_memory(), left_to_the_process());
}

std::size_t free_memory() {
  return std::min(left_to_the_system(), left_to_the_group());
}

std::size_t memory_limit() {
  rlimit limit{};
  return getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY ? unlimited : limit.rlim_cur;
}

ProcessMemory memory_of_process(int process) {
  std::ifstream file(fmt::format("/proc/{}/statm", process));
  std::size_t all = 0;
  std::size_t resident = 0;
  return file >> all >> resident ? ProcessMemory{resident * page_size(), all * page_size()} : ProcessMemory();
}

std::string memory_text(std::size_t bytes) {
  const auto number = static_cast<double>(bytes);
  if (number >= 0.9995e9)
    return two_digits(number / 1e9, "GB");
  if (number >= 0.9995e6)
    return two_digits(number / 1e6, "MB");
  return two_digits(number / 1e3, "kB");
}

TooLargeForMemory::TooLargeForMemory(std::size_t needed_bytes, std::size_t available_bytes)
    : std::runtime_error(
          fmt::format("the factor of the matrix needs {:.2g} GB of memory, of which {:.2g} GB are left",
                      in_gigabytes(needed_bytes), in_gigabytes(available_bytes))),
      needed(needed_bytes), available(available_bytes) {}

} // namespace rubato::linalg
