// SPDX-License-Identifier: LGPL-3.0-or-later
/// Files that are written to their end or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <stdexcept>

namespace rubato {

/// A file could not be written to its end: the disk is full, or gone. Programs end on it with exit code 4.
class WriteError : public std::runtime_error {
public:
  /// `reason`: the error number of the system, 0 when it is not known.
  explicit WriteError(const std::filesystem::path& path, int reason = 0);
  int reason = 0;
};

/// Has `write` write a file beside `path` and renames it then: whoever looks for `path` finds the former file
/// or the whole new one. What `write` throws passes, and the file beside is gone then; a WriteError is told
/// of `path`. Throws WriteError when the file cannot be renamed.
void write_whole(const std::filesystem::path& path,
                 const std::function<void(const std::filesystem::path& beside)>& write);

/// Closes a stream. Throws WriteError, naming `path`, when anything of it could not be written.
void finish_writing(std::ofstream& stream, const std::filesystem::path& path);

/// Throws WriteError when a file cannot grow by so many bytes, as far as the system tells: for libraries that
/// leave a damaged file behind when the disk is full.
void require_room(const std::filesystem::path& path, std::uintmax_t bytes);

} // namespace rubato
