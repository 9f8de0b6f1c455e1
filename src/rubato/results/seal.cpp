// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/seal.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>
#include <zlib.h>

namespace rubato::results {
namespace {

constexpr std::string_view magic = "rubato checkpoint, format ";
constexpr std::size_t piece_size = std::size_t{1} << 20;

struct Content {
  std::uintmax_t size = 0;
  std::uint32_t crc = 0;
  bool operator==(const Content&) const = default;
};

/// Of what comes after the head.
Content content_of(std::istream& file) {
  Content content;
  std::vector<char> bytes(piece_size);
  file.seekg(seal_size);
  while (file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || file.gcount() > 0) {
    const auto count = static_cast<std::size_t>(file.gcount());
    content.crc = crc(bytes.data(), count, content.crc);
    content.size += count;
  }
  return content;
}

std::string head_of(const Content& content) {
  auto head =
      fmt::format("{}{}\n{} bytes, CRC-32 {:08x}\n", magic, checkpoint_format, content.size, content.crc);
  head.resize(seal_size, '\0');
  return head;
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format("{}: {}; without --resume the run starts over", path.string(), what));
}

/// A file that outlives a crash of the machine, too.
void write_through(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_WRONLY);
  const bool done = file >= 0 && fsync(file) == 0;
  const int reason = errno;
  if (file >= 0)
    close(file);
  if (!done)
    throw WriteError(path, reason);
}

} // namespace

void seal(const std::filesystem::path& path) {
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const auto head = head_of(content_of(file));
    file.clear();
    file.seekp(0);
    errno = 0;
    file << head << std::flush;
    if (!file)
      throw WriteError(path, errno);
  }
  write_through(path);
}

void check_seal(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file)
    refuse(path, "the checkpoint cannot be read");
  std::string head(seal_size, '\0');
  file.read(head.data(), seal_size);
  if (!head.starts_with(magic))
    refuse(path, "is no checkpoint of this program");
  int format = 0;
  std::uintmax_t size = 0;
  unsigned sum = 0;
  const auto count =
      std::sscanf(head.c_str() + magic.size(), "%d\n%ju bytes, CRC-32 %8x\n", &format, &size, &sum);
  if (count >= 1 && format != checkpoint_format)
    refuse(path, fmt::format("the checkpoint has format {}, this program reads format {}", format,
                             checkpoint_format));
  file.clear();
  const auto content = content_of(file);
  if (count == 3 && content.size < size)
    refuse(path, fmt::format("the checkpoint is truncated: it has {} of its {} bytes",
                             content.size + seal_size, size + seal_size));
  if (head != head_of(content))
    refuse(path, "the checkpoint is damaged: its checksum is not that of its content");
}

std::uint32_t crc(const void* bytes, std::size_t size, std::uint32_t before) {
  return static_cast<std::uint32_t>(crc32_z(before, static_cast<const Bytef*>(bytes), size));
}

} // namespace rubato::results
