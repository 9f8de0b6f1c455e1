// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/csv_table.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>
#include <vector>

namespace rubato::deck {
namespace {

constexpr std::size_t longest_line = 100'000;
/// An echo of them must remain a deck that can be read.
constexpr std::size_t most_rows = 50'000;

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string_view without_quotes(std::string_view text) {
  const bool quoted = text.size() > 1 && text.front() == '"' && text.back() == '"';
  return quoted ? text.substr(1, text.size() - 2) : text;
}

char separator_of(std::string_view names) {
  for (const char separator : {';', ','})
    if (names.find(separator) != std::string_view::npos)
      return separator;
  return '\t';
}

std::vector<std::string_view> entries_of(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  for (;;) {
    const auto end = line.find(separator);
    cells.push_back(without_quotes(without_blanks(line.substr(0, end))));
    if (end == std::string_view::npos)
      return cells;
    line.remove_prefix(end + 1);
  }
}

class CsvTableReader {
public:
  explicit CsvTableReader(const std::filesystem::path& file) : file_(file.string()), stream_(file) {
    if (!std::filesystem::exists(file))
      fail(fmt::format("file {} does not exist", shown(file_)));
    if (!std::filesystem::is_regular_file(file) || !stream_)
      fail(fmt::format("file {} cannot be read", shown(file_)));
  }

  LinearTable read(const std::string& at, const std::string& values) {
    if (!next_line())
      fail("found no line, expected names of columns and numbers below");
    separator_ = separator_of(line_);
    const auto names = entries_of(line_, separator_);
    column_names_.assign(names.begin(), names.end());
    const auto column_at = at.empty() ? 0 : column_of(at);
    const auto column_values = column_of(values);
    LinearTable table;
    while (next_line())
      add_row(column_at, column_values, table);
    if (table.at.empty())
      fail("found no numbers below the names of the columns");
    return table;
  }

private:
  [[noreturn]] void fail(const std::string& text) const { throw InputError(text, {file_, number_}); }

  /// The next line that says something.
  bool next_line() {
    while (std::getline(stream_, line_)) {
      ++number_;
      if (number_ == 1 && line_.starts_with("\xEF\xBB\xBF"))
        line_.erase(0, 3);
      if (line_.size() > longest_line)
        fail("found a line that is too long, expected a table of numbers");
      const auto text = without_blanks(line_);
      if (!text.empty() && text.front() != '#')
        return true;
    }
    return false;
  }

  std::size_t column_of(const std::string& name) const {
    const auto found = std::ranges::find(column_names_, name);
    if (found == column_names_.end())
      fail(fmt::format("found no column {}{}", shown(name), suggestion(name, column_names_)));
    return static_cast<std::size_t>(found - column_names_.begin());
  }

  double number_in(const std::vector<std::string_view>& cells, std::size_t column) const {
    if (column >= cells.size())
      fail(fmt::format("found {} columns, expected {}", cells.size(), column_names_.size()));
    auto text = cells[column];
    if (text.size() > 1 && text.front() == '+' && text[1] != '-')
      text.remove_prefix(1);
    double number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(number))
      fail(fmt::format("found {} in the column {}, expected a number", shown(std::string(cells[column])),
                       shown(column_names_[column])));
    return number;
  }

  void add_row(std::size_t column_at, std::size_t column_values, LinearTable& table) const {
    const auto cells = entries_of(line_, separator_);
    const double at = number_in(cells, column_at);
    if (!table.at.empty() && !(at > table.at.back()))
      fail(fmt::format("found {} after {} in the column {}, expected numbers that ascend", at,
                       table.at.back(), shown(column_names_[column_at])));
    if (table.at.size() == most_rows)
      fail(fmt::format("found more than {} rows, expected a shorter table", most_rows));
    table.at.push_back(at);
    table.values.push_back(number_in(cells, column_values));
  }

  std::string file_;
  std::ifstream stream_;
  std::string line_;
  int number_ = 0;
  char separator_ = ',';
  std::vector<std::string> column_names_;
};

} // namespace

LinearTable read_csv_table(const std::filesystem::path& file, const std::string& at,
                           const std::string& values) {
  return CsvTableReader(file).read(at, values);
}

} // namespace rubato::deck
