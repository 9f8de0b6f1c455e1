// SPDX-License-Identifier: LGPL-3.0-or-later
/// Named arrays and texts in an HDF5 file, by the serial library. MED files belong to another HDF5 library
/// in the same process (mesh/io): no handle of one may come to the other.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::results {

class Hdf5File {
public:
  enum class Access { create, read };

  /// `user_block`: bytes in front that HDF5 leaves alone, a power of two from 512 on. Throws
  /// std::runtime_error when the file cannot be opened or made.
  Hdf5File(const std::filesystem::path& path, Access access, std::uint64_t user_block = 0);
  ~Hdf5File();
  Hdf5File(const Hdf5File&) = delete;
  Hdf5File& operator=(const Hdf5File&) = delete;

  /// Names may have parts, "state/u". Throw WriteError when writing fails.
  void write(const std::string& name, std::span<const double> values);
  void write(const std::string& name, std::span<const std::int64_t> values);
  void write(const std::string& name, std::string_view text);

  /// Whether there is an array or a text of that name, in a group that there is.
  bool has(const std::string& name) const;
  /// Throw std::runtime_error when there is no such thing.
  std::vector<double> numbers(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  std::string text(const std::string& name) const;

  /// Writes what is still in memory and closes. Throws WriteError when that fails.
  void close();

private:
  [[noreturn]] void fail(const std::string& what) const;
  void write_array(const std::string& name, std::int64_t type, std::uint64_t size, const void* values);
  std::uint64_t size_of(std::int64_t data) const;
  template <class T> std::vector<T> array(const std::string& name, std::int64_t type) const;

  std::filesystem::path path_;
  std::int64_t id_ = -1; ///< HDF5's hid_t
};

} // namespace rubato::results
