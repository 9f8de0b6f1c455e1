// SPDX-License-Identifier: LGPL-3.0-or-later
/// How much memory a factor may take.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace rubato::linalg {

/// Memory that can still be had [bytes]: the least of what the system has left, of what the control groups
/// and the resource limits of the process leave it. The largest number where none of them can be read.
std::size_t available_memory();

/// The part of it that all processes share, without the limits of this one [bytes].
std::size_t free_memory();
/// What the resource limits leave a process of its address space, all told [bytes]; the largest number
/// without a limit.
std::size_t memory_limit();

/// What a process has [bytes]; 0 where that cannot be read.
struct ProcessMemory {
  std::size_t resident = 0;
  std::size_t address_space = 0;
};
ProcessMemory memory_of_process(int process);

/// "2.6 GB", "38 MB", "512 kB"
std::string memory_text(std::size_t bytes);

/// A factor would need more than there is. Thrown before it is computed.
class TooLargeForMemory : public std::runtime_error {
public:
  TooLargeForMemory(std::size_t needed_bytes, std::size_t available_bytes);
  std::size_t needed = 0;
  std::size_t available = 0;
};

} // namespace rubato::linalg
