// SPDX-License-Identifier: LGPL-3.0-or-later
/// Tables as text, a line at a time: what is written stays readable however the run ends.
#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace rubato::results {

/// A comma-separated file with one header line. Numbers are written so that reading them gives the same bits.
class CsvWriter {
public:
  /// Throws InputError, naming the file, when it cannot be written.
  CsvWriter(std::filesystem::path path, std::span<const std::string> columns);
  /// Throws std::runtime_error when writing fails.
  void row(std::span<const double> values);

private:
  std::filesystem::path path_;
  std::ofstream file_;
};

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;
  /// Index of a column, or −1.
  int column(const std::string& name) const;
};

/// Reads back what CsvWriter wrote. Throws InputError, with file and line, for anything else.
Table read_csv(const std::filesystem::path& path);

} // namespace rubato::results
