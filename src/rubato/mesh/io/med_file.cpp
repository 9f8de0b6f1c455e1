// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/med_file.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"
#include "rubato/mesh/io/med_library.hpp"

#include <fmt/format.h>
#include <med.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <numeric>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace rubato::mesh::med {
namespace {

static_assert(name_size == MED_NAME_SIZE);
static_assert(group_name_size == MED_LNAME_SIZE);
static_assert(short_name_size == MED_SNAME_SIZE);

constexpr std::string_view hdf5_signature{"\x89HDF\r\n\x1a\n", 8};

std::uint64_t little_endian(std::string_view bytes) {
  return std::accumulate(bytes.rbegin(), bytes.rend(), std::uint64_t{0}, [](std::uint64_t value, char byte) {
    return (value << 8) | static_cast<unsigned char>(byte);
  });
}

/// The length that an HDF5 superblock announces (HDF5 file format specification, II.A); nothing for a
/// superblock that is none.
std::optional<std::uint64_t> announced_length(std::string_view head) {
  constexpr std::size_t version_at = 8;
  const int version = static_cast<unsigned char>(head[version_at]);
  const bool old = version == 0 || version == 1;
  const auto address_size = static_cast<std::size_t>(static_cast<unsigned char>(head[old ? 13 : 9]));
  const std::size_t addresses_at = old ? (version == 0 ? 24 : 28) : 12;
  const auto end_at = addresses_at + 2 * address_size;
  if (version > 3 || address_size < 2 || address_size > 8 || end_at + address_size > head.size())
    return std::nullopt;
  return little_endian(head.substr(end_at, address_size));
}

/// What speaks against a file before any library looks at it; empty when nothing does.
std::string fault_of(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    return "does not exist";
  if (std::filesystem::is_directory(status))
    return "is a directory, a MED file was expected";
  if (!std::filesystem::is_regular_file(status))
    return "is not a regular file, a MED file was expected";

  std::ifstream stream(path, std::ios::binary);
  if (!stream)
    return "cannot be read: permission denied";
  std::array<char, 64> bytes{};
  stream.read(bytes.data(), bytes.size());
  const std::string_view head(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (head.empty())
    return "is empty, a MED file was expected";
  const auto common = std::min(head.size(), hdf5_signature.size());
  if (head.substr(0, common) != hdf5_signature.substr(0, common))
    return "is not a MED file: it does not begin as an HDF5 file";

  const auto length = std::filesystem::file_size(path, error);
  if (head.size() < bytes.size())
    return fmt::format("is truncated: it ends after {} bytes", head.size());
  const auto announced = announced_length(head);
  if (!announced)
    return "is damaged: its HDF5 header makes no sense";
  if (*announced > length)
    return fmt::format("is truncated: it has {} of its {} bytes", length, *announced);
  return {};
}

/// What speaks against the version of an open file; empty when nothing does.
std::string version_fault(med_idt id, const std::filesystem::path& path) {
  med_int major = 0;
  med_int minor = 0;
  med_int release = 0;
  if (library().file_num_version_read(id, &major, &minor, &release) < 0)
    return "is an HDF5 file but not a MED file: it has no MED version";
  if (std::tuple(major, minor) > std::tuple(MED_MAJOR_NUM, MED_MINOR_NUM))
    return fmt::format("is of MED version {}.{}.{}, newer than {}.{}, the newest this program reads", major,
                       minor, release, MED_MAJOR_NUM, MED_MINOR_NUM);
  if (major < 3)
    return fmt::format(
        "is of MED version {}.{}.{}, older than 3.0, the oldest this program reads; MED's tools (on "
        "Debian the package libmed-tools) convert it: medimport {} new.med",
        major, minor, release, path.string());
  return {};
}

med_access_mode mode_of(File::Access access) {
  switch (access) {
  case File::Access::read:
    return MED_ACC_RDONLY;
  case File::Access::extend:
    return MED_ACC_RDWR;
  case File::Access::create:
    return MED_ACC_CREAT;
  }
  return MED_ACC_UNDEF;
}

} // namespace

Silence::Silence() {
  std::fflush(stderr);
  kept_ = dup(STDERR_FILENO);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (kept_ >= 0 && nowhere >= 0)
    dup2(nowhere, STDERR_FILENO);
  if (nowhere >= 0)
    close(nowhere);
}

Silence::~Silence() {
  if (kept_ < 0)
    return;
  std::fflush(stderr);
  dup2(kept_, STDERR_FILENO);
  close(kept_);
}

namespace {

// HDF5 closes itself at the program's end and prints that it cannot, when an error has cost it handles.
// Closing it earlier would end that too, but MED then misreads the next file of an older version.
void close_library_silently_at_exit() {
  static const int registered = std::atexit([] {
    const Silence silence;
    library().library_close();
  });
  static_cast<void>(registered);
}

} // namespace

Handle::~Handle() {
  if (id < 0)
    return;
  library().file_close(id);
  close_library_silently_at_exit();
}

File::File(const std::filesystem::path& path, Access access, const std::filesystem::path& called)
    : path_(called.empty() ? path : called), access_(access) {
  if (access == Access::create)
    handle_.id = library().file_open(path.c_str(), mode_of(access));
  else
    open_checked();
  if (handle_.id < 0)
    refuse("cannot be written: is there such a folder, and may you write into it?");
}

void File::close() {
  const auto id = std::exchange(handle_.id, -1);
  close_library_silently_at_exit();
  if (library().file_close(id) < 0)
    throw WriteError(path_);
}

void File::open_checked() {
  if (const auto fault = fault_of(path_); !fault.empty())
    refuse(fault);
  size_ = std::filesystem::file_size(path_);
  handle_.id = library().file_open(path_.c_str(), mode_of(access_));
  if (handle_.id < 0)
    refuse("cannot be opened as a MED file: it is an HDF5 file without MED's version, or damaged");
  if (const auto fault = version_fault(handle_.id, path_); !fault.empty())
    refuse(fault);
}

void File::check(std::int64_t result, std::string_view what) const {
  if (result >= 0)
    return;
  if (access_ != Access::read)
    throw WriteError(path_);
  refuse(fmt::format("is damaged: its {} cannot be read", what));
}

std::size_t File::plausible(std::int64_t count, std::string_view what) const {
  check(count, what);
  // Deflate, the strongest packing HDF5 offers, makes at most 1032 bytes of one.
  constexpr std::uintmax_t strongest_packing = 1032;
  if (static_cast<std::uintmax_t>(count) > size_ * strongest_packing / sizeof(med_int))
    refuse(fmt::format("is damaged: it announces {} {}", count, what));
  return static_cast<std::size_t>(count);
}

void File::refuse(std::string_view text) const {
  throw InputError(fmt::format("mesh file '{}' {}", path_.string(), text));
}

void rehearse(const std::filesystem::path& path, const std::function<void()>& read) {
  library(); // loaded before the fork: otherwise both processes load it
  const auto child = fork();
  if (child == 0) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    for (const int deadly : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
      std::signal(deadly, SIG_DFL);
    try {
      read();
    } catch (const std::exception&) { // the reader itself will meet it again, and throw it
    }
    _exit(EXIT_SUCCESS);
  }
  // Where no process can be had there is nothing to learn.
  if (child < 0)
    return;
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != EXIT_SUCCESS)
    throw InputError(fmt::format("mesh file '{}' is damaged: HDF5 breaks down on it", path.string()));
}

std::string text_buffer(std::size_t count, std::size_t width) {
  return std::string(count * width + 1, '\0');
}

std::string text_at(std::string_view buffer, std::size_t index, std::size_t width) {
  auto text = buffer.substr(index * width, width);
  text = text.substr(0, text.find('\0'));
  const auto last = text.find_last_not_of(' ');
  return std::string(text.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

std::string joined_texts(const std::vector<std::string>& texts, std::size_t width) {
  std::string all;
  all.reserve(texts.size() * width);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    all += texts[i].substr(0, width);
    all.resize((i + 1) * width, ' ');
  }
  return all;
}

} // namespace rubato::mesh::med
