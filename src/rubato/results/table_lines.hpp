// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the parts of tables.dat.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/ccx_contact.hpp"
#include "rubato/results/ccx_numbers.hpp"
#include "rubato/step/state.hpp"
#include "rubato/study/outputs.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

namespace rubato::results {

/// The source of the lines of a table.
struct TableSource {
  const model::Model& model;
  const step::State& now;
  const CcxNumbers& numbers;
  const study::PrintedTable& table;
};

/// Text of tables.dat: blank line, heading, blank line, then its lines.
class TableText {
public:
  explicit TableText(double t) : time_(fortran_e(t, 7)) {}

  /// " <what>for set <label> and time <t>"
  void heading(std::string_view what, std::string_view label) {
    fmt::format_to(std::back_inserter(text_), "\n {}for set {} and time {:>14}\n\n", what, label, time_);
  }
  /// " <what><t>"
  void plain_heading(std::string_view what) {
    fmt::format_to(std::back_inserter(text_), "\n {}{:>14}\n\n", what, time_);
  }
  void line(std::int64_t number, std::span<const double> values) {
    fmt::format_to(std::back_inserter(text_), "{:10}", number);
    numbers(values);
  }
  void line(std::int64_t number, std::int64_t second, int width, std::span<const double> values) {
    fmt::format_to(std::back_inserter(text_), "{:10}{:{}}", number, second, width);
    numbers(values);
  }
  void indented(std::size_t columns, std::span<const double> values) {
    text_.append(columns, ' ');
    numbers(values);
  }
  void words(std::string_view text) { text_ += text; }
  const std::string& text() const { return text_; }
  const std::string& time() const { return time_; }

private:
  void numbers(std::span<const double> values);

  std::string text_;
  std::string time_;
};

inline constexpr std::size_t total_indent = 6;

/// How headings name what a table is of.
std::string_view label_of(const study::PrintedTable& table);
/// Returns whether a quantity with sums lists its lines.
bool has_lines(const study::PrintedTable& table);
bool has_totals(const study::PrintedTable& table);
bool lists(const study::PrintedTable& table, std::string_view quantity);

void add_node_tables(const TableSource& source, TableText& text);
void add_cell_tables(const TableSource& source, TableText& text);
void add_face_tables(const TableSource& source, TableText& text);
void add_contact_tables(const TableSource& source, ContactLister& lister, TableText& text);

} // namespace rubato::results
