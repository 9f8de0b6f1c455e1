// SPDX-License-Identifier: LGPL-3.0-or-later
/// Tables as text, a line at a time: what is written stays readable however the run ends.
#pragma once

#include "rubato/core/error.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::results {

/// A file that grows by whole lines.
class LineFile {
public:
  /// A new file. Throws InputError, naming it, when it cannot be written.
  explicit LineFile(std::filesystem::path path);
  /// Goes on after the first `bytes` of a file that is there; the rest of it is gone then. Throws InputError,
  /// naming it, when it is shorter or cannot be written.
  LineFile(std::filesystem::path path, std::uintmax_t bytes);

  /// Throws WriteError when writing fails; the file ends with its last whole line then.
  void add(std::string_view line);
  /// Takes lines back: only the first `bytes` stay.
  void cut(std::uintmax_t bytes);
  std::uintmax_t bytes() const { return bytes_; }

private:
  std::filesystem::path path_;
  std::ofstream file_;
  std::uintmax_t bytes_ = 0;
};

/// A comma-separated file with one header line. Numbers are written so that reading them gives the same bits.
class CsvWriter {
public:
  /// Throws InputError, naming the file, when it cannot be written.
  CsvWriter(const std::filesystem::path& path, std::span<const std::string> columns);
  /// Goes on with a table that is there, as LineFile does.
  CsvWriter(const std::filesystem::path& path, std::uintmax_t bytes) : file_(path, bytes) {}
  /// Throws WriteError as LineFile does.
  void row(std::span<const double> values);
  void cut(std::uintmax_t bytes) { file_.cut(bytes); }
  std::uintmax_t bytes() const { return file_.bytes(); }

private:
  LineFile file_;
};

/// Calls `line` for each line of a table, the header too, with its values as text and its place. Throws
/// InputError, with file and line, when the file cannot be read or a line has another number of values than
/// the header.
void read_csv_lines(
    const std::filesystem::path& path,
    const std::function<void(std::span<const std::string_view> values, const Location& at)>& line);

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  /// Index of a column, or −1.
  int column(const std::string& name) const;
};

/// Reads back what CsvWriter wrote. Throws InputError, with file and line, for anything else.
Table read_csv(const std::filesystem::path& path);

} // namespace rubato::results
