// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/csv.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <string_view>

namespace rubato::results {
namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> parts;
  std::size_t begin = 0;
  for (std::size_t comma = line.find(','); comma != std::string_view::npos; comma = line.find(',', begin)) {
    parts.push_back(line.substr(begin, comma - begin));
    begin = comma + 1;
  }
  parts.push_back(line.substr(begin));
  return parts;
}

double number(std::string_view text, const Location& at) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw InputError(fmt::format("found '{}', expected a number", text), at);
  return value;
}

} // namespace

LineFile::LineFile(std::filesystem::path path) : path_(std::move(path)), file_(path_, std::ios::trunc) {
  if (!file_)
    throw InputError(fmt::format("{}: cannot be written", path_.string()));
}

LineFile::LineFile(std::filesystem::path path, std::uintmax_t bytes) : path_(std::move(path)), bytes_(bytes) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path_, error);
  if (error || size < bytes)
    throw InputError(fmt::format("{}: found {}, expected the {} bytes that the checkpoint counts on",
                                 path_.string(), error ? error.message() : fmt::format("{} bytes", size),
                                 bytes));
  std::filesystem::resize_file(path_, bytes, error);
  file_.open(path_, std::ios::app);
  if (error || !file_)
    throw InputError(fmt::format("{}: cannot be written", path_.string()));
}

void LineFile::add(std::string_view line) {
  errno = 0;
  file_ << line << '\n' << std::flush;
  if (!file_) {
    const int reason = errno;
    cut(bytes_);
    throw WriteError(path_, reason);
  }
  bytes_ += line.size() + 1;
}

void LineFile::cut(std::uintmax_t bytes) {
  file_.close(); // first: what a stream could not write it would try again
  file_.clear();
  std::error_code ignored; // a shorter file needs no room
  std::filesystem::resize_file(path_, bytes, ignored);
  file_.open(path_, std::ios::app);
  bytes_ = bytes;
}

CsvWriter::CsvWriter(const std::filesystem::path& path, std::span<const std::string> columns) : file_(path) {
  file_.add(fmt::format("{}", fmt::join(columns, ",")));
}

void CsvWriter::row(std::span<const double> values) {
  file_.add(fmt::format("{}", fmt::join(values, ",")));
}

int Table::column(const std::string& name) const {
  const auto found = std::ranges::find(columns, name);
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

void read_csv_lines(const std::filesystem::path& path,
                    const std::function<void(std::span<const std::string_view>, const Location&)>& line) {
  std::ifstream file(path);
  if (!file)
    throw InputError(fmt::format("{}: cannot be read", path.string()));
  std::string text;
  std::size_t columns = 0;
  for (int number_of_line = 1; std::getline(file, text); ++number_of_line) {
    const Location at{path.string(), number_of_line, 1};
    if (text.ends_with('\r')) // other programs' tables may end their lines so
      text.pop_back();
    const auto values = split(text);
    if (number_of_line == 1)
      columns = values.size();
    if (values.size() != columns)
      throw InputError(fmt::format("found {} values, expected {}", values.size(), columns), at);
    line(values, at);
  }
}

Table read_csv(const std::filesystem::path& path) {
  Table table;
  read_csv_lines(path, [&](std::span<const std::string_view> values, const Location& at) {
    if (at.line == 1) {
      table.columns.assign(values.begin(), values.end());
      return;
    }
    auto& row = table.rows.emplace_back();
    for (const auto value : values)
      row.push_back(number(value, at));
  });
  return table;
}

} // namespace rubato::results
