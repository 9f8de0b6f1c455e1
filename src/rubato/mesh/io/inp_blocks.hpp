// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: an .inp file as keywords with their parameters and data lines.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/mesh/io/inp_keywords.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::mesh::inp {

/// A part of a file and where it stands. Refers to the text that a Source holds.
struct Word {
  std::string_view text;
  const std::string* file = nullptr;
  int line = 0;
  int column = 0;

  bool empty() const { return text.empty(); }
  Location at() const { return {file == nullptr ? "" : *file, line, column}; }
};

struct Parameter {
  std::string key; ///< compact
  Word name;
  Word value; ///< empty: none
};

/// A data line without comments.
struct Line {
  std::string_view text;
  const std::string* file = nullptr;
  int line = 0;
};

struct Block {
  const Keyword* keyword = nullptr; ///< nullptr: no keyword of the table
  Word at;                          ///< the keyword with its '*'
  std::vector<Parameter> parameters;
  std::vector<Line> lines; ///< blank ones too, but not at the end

  bool is(std::string_view name) const { return keyword != nullptr && keyword->name == name; }
  /// nullptr when it is not there. `key`: compact.
  const Parameter* find(std::string_view key) const;
};

/// What is wrong with a file, gathered. The same sentence at one place is told once; after the hundredth
/// sentence they are only counted.
class Faults {
public:
  void add(const Word& at, std::string text);
  void add(const Location& at, std::string text);
  bool empty() const { return faults_.empty(); }
  /// Throws one InputError with all of them, in the order of the file.
  void throw_if_any();

private:
  std::vector<Fault> faults_;
  std::size_t more_ = 0;
};

/// The whole text, with the files that it includes.
struct Source {
  std::deque<std::string> texts; ///< of each file
  std::deque<std::string> names;
  std::vector<Block> blocks;
};

/// Reads a file and those it includes, by *INCLUDE or by the parameter INPUT of a keyword with data; these
/// are relative to the folder of the file that names them. Throws InputError when the first file cannot be
/// read; everything else is a fault.
Source read_source(const std::filesystem::path& path, Faults& faults);
/// The same from text that is there; `name` stands in the places of faults, its folder is where included
/// files are.
Source parse_source(std::string text, const std::string& name, Faults& faults);

/// The values of a line between its commas, without the blanks around them and without quotes; a comma at the
/// end adds none.
std::vector<Word> fields_of(const Line& line);
/// The first characters of a line, for messages.
Word word_of(const Line& line);
/// The fields of the line at that place, none where there is no such line.
std::vector<Word> fields_at(const Block& block, std::size_t line);
bool is_blank(const Line& line);

/// Integers and numbers in Fortran's forms, 1, .1E1, +10.D-1; nothing for other text and what is not finite.
std::optional<std::int64_t> integer_in(std::string_view text);
std::optional<double> number_in(std::string_view text);

/// The number, or a fault that says what was expected: "a coordinate". An empty word is `absent`, or a fault
/// without one.
std::optional<double> require_number(const Word& word, std::string_view expected, Faults& faults,
                                     std::optional<double> absent = std::nullopt);
std::optional<std::int64_t> require_integer(const Word& word, std::string_view expected, Faults& faults);

/// Faults for parameters that the keyword's row does not have.
void check_parameters(const Block& block, Faults& faults);
/// The value of a parameter; an empty word and a fault when it is missing or empty.
Word require_value(const Block& block, std::string_view key, std::string_view expected, Faults& faults);
/// The field at that place of a line; an empty word at the line's begin when there is none.
Word field(const std::vector<Word>& fields, std::size_t place, const Word& otherwise);

} // namespace rubato::mesh::inp
