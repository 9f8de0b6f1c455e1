// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/writing.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <sys/resource.h>
#include <system_error>

namespace rubato {
namespace {

namespace fs = std::filesystem;

std::string sentence(const fs::path& path, int reason) {
  return fmt::format("{}: writing failed{}", path.string(),
                     reason == 0 ? ", is the disk full?"
                                 : fmt::format(" ({})", std::generic_category().message(reason)));
}

} // namespace

WriteError::WriteError(const fs::path& path, int error)
    : std::runtime_error(sentence(path, error)), reason(error) {}

void write_whole(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  auto beside = path;
  beside += ".new";
  std::error_code ignored;
  try {
    write(beside);
    fs::rename(beside, path);
  } catch (const WriteError& error) {
    fs::remove(beside, ignored);
    throw WriteError(path, error.reason);
  } catch (const fs::filesystem_error& error) {
    fs::remove(beside, ignored);
    throw WriteError(path, error.code().value());
  } catch (...) {
    fs::remove(beside, ignored);
    throw;
  }
}

void finish_writing(std::ofstream& stream, const fs::path& path) {
  if (stream)
    errno = 0;
  stream.close();
  if (!stream)
    throw WriteError(path, errno);
}

void require_room(const fs::path& path, std::uintmax_t bytes) {
  std::error_code error;
  const auto space = fs::space(path.has_parent_path() ? path.parent_path() : fs::path("."), error);
  if (!error && space.available < bytes)
    throw WriteError(path, ENOSPC);
  rlimit limit{};
  const auto size = fs::file_size(path, error);
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      (error ? 0 : size) + bytes > limit.rlim_cur)
    throw WriteError(path, EFBIG);
}

} // namespace rubato
