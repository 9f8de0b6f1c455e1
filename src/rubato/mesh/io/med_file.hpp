// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: an open MED file and its texts, without the MED library's header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::mesh::med {

constexpr std::size_t name_size = 64;       ///< MED_NAME_SIZE: meshes, families, fields
constexpr std::size_t group_name_size = 80; ///< MED_LNAME_SIZE
constexpr std::size_t short_name_size = 16; ///< MED_SNAME_SIZE: axes, components, units

/// Standard error shut while it lives: MED and HDF5 print their own traces there before they return an error.
class Silence {
public:
  Silence();
  ~Silence();
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

private:
  int kept_ = -1;
};

/// A file's identifier in MED, closed with all that is open in the file when it goes.
class Handle {
public:
  Handle() = default;
  ~Handle();
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  std::int64_t id = -1;
};

/// An open file, closed when it goes.
class File {
public:
  enum class Access { read, extend, create };

  /// Throws InputError, with the reason, when the file can't be opened as MED. `called`: what faults call it
  /// when not by its path.
  File(const std::filesystem::path& path, Access access, const std::filesystem::path& called = {});

  std::int64_t id() const { return handle_.id; }
  const std::filesystem::path& path() const { return path_; }

  /// Of a file that is read, throws InputError when a call of the library gave a negative result; of one that
  /// is written, WriteError.
  void check(std::int64_t result, std::string_view what) const;
  /// To be called when all is written: the library still has some of it. Throws WriteError.
  void close();
  /// `count` as an array size. Throws InputError when it is negative or more than this file could ever hold.
  std::size_t plausible(std::int64_t count, std::string_view what) const;
  /// Throws InputError with the file's name before `text`.
  [[noreturn]] void refuse(std::string_view text) const;

private:
  void open_checked();

  std::filesystem::path path_;
  Access access_;
  std::uintmax_t size_ = 0;
  Silence silence_;
  Handle handle_;
};

/// Runs `read` in a process of its own and forgets what came of it. Throws InputError when that process broke
/// down: HDF5 has damaged files on which it crashes, and then a program that has rehearsed goes on.
void rehearse(const std::filesystem::path& path, const std::function<void()>& read);

/// Space for `count` texts of `width` characters as MED wants it.
std::string text_buffer(std::size_t count, std::size_t width);

/// The `index`-th text of that width, without the blanks and zeros that fill it.
std::string text_at(std::string_view buffer, std::size_t index, std::size_t width);

/// Texts one after another, each filled with blanks to the width (and cut there).
std::string joined_texts(const std::vector<std::string>& texts, std::size_t width);

} // namespace rubato::mesh::med
