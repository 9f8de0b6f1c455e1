// SPDX-License-Identifier: LGPL-3.0-or-later
// Syntax: what Abaqus and CalculiX have in common, and the forms that only one of them takes.
#include "rubato/mesh/io/inp_blocks.hpp"

#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/file_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>

namespace rubato::mesh::inp {
namespace {

namespace fs = std::filesystem;

constexpr int most_nested_files = 16;
constexpr std::size_t most_files = 1000;
constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos)
    return text.substr(0, 0);
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string_view unquoted(std::string_view text) {
  const bool quoted =
      text.size() >= 2 && text.front() == text.back() && (text.front() == '"' || text.front() == '\'');
  return quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

/// Where the next comma outside of quotes is; the size of the text when there is none.
std::size_t comma_in(std::string_view text) {
  char quote = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (quote != 0)
      quote = text[i] == quote ? 0 : quote;
    else if (text[i] == '"')
      quote = text[i];
    else if (text[i] == ',')
      return i;
  }
  return text.size();
}

Word part_of(const Line& line, std::string_view part) {
  return {part, line.file, line.line, static_cast<int>(part.data() - line.text.data()) + 1};
}

bool is_comment(std::string_view text) {
  return trimmed(text).starts_with("**");
}
bool is_keyword_line(std::string_view text) {
  return trimmed(text).starts_with('*') && !is_comment(text);
}

/// The lines of one text.
class Lines {
public:
  Lines(std::string_view text, const std::string& file) : rest_(text), file_(&file) {}

  /// The next one that is no comment; false at the end.
  bool next(Line& line) {
    do {
      if (rest_.empty())
        return false;
      const auto end = std::min(rest_.find('\n'), rest_.size());
      line = {rest_.substr(0, end), file_, ++number_};
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      while (!line.text.empty() && blanks.find(line.text.back()) != std::string_view::npos)
        line.text.remove_suffix(1);
    } while (is_comment(line.text));
    return true;
  }

  /// Whether the next line that is no comment goes on with data, not with a keyword.
  bool goes_on() const {
    auto copy = *this;
    Line line;
    return copy.next(line) && !is_keyword_line(line.text);
  }

private:
  std::string_view rest_;
  const std::string* file_;
  int number_ = 0;
};

void add_parameter(const Line& line, std::string_view text, Block& block) {
  const auto equals = text.find('=');
  const auto name = trimmed(text.substr(0, equals));
  if (name.empty() && equals == std::string_view::npos)
    return;
  Parameter parameter{compact(name), part_of(line, name), part_of(line, name.substr(name.size()))};
  if (equals != std::string_view::npos)
    parameter.value = part_of(line, unquoted(trimmed(text.substr(equals + 1))));
  block.parameters.push_back(std::move(parameter));
}

/// A list of words between commas has the word.
bool lists(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const auto end = std::min(list.find(','), list.size());
    if (list.substr(0, end) == word)
      return true;
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return false;
}

/// Reads keywords and data lines of files into a source.
class Reader {
public:
  Reader(Source& source, Faults& faults) : source_(source), faults_(faults) {}

  void read(std::string text, const std::string& name, int depth) {
    source_.texts.push_back(std::move(text));
    source_.names.push_back(name);
    const std::string_view content = source_.texts.back();
    Lines lines(content, source_.names.back());
    for (Line line; lines.next(line);) {
      if (is_keyword_line(line.text))
        read_keyword(line, lines, depth);
      else
        add_data(line);
    }
  }

private:
  void add_data(const Line& line) {
    if (!source_.blocks.empty())
      source_.blocks.back().lines.push_back(line);
    else if (!is_blank(line))
      faults_.add(word_of(line),
                  fmt::format("found {} before the first keyword, expected a line that begins with '*'",
                              shown(std::string(trimmed(line.text)))));
  }

  void read_keyword(Line line, Lines& lines, int depth) {
    const auto text = trimmed(line.text);
    auto end = comma_in(text);
    const auto name = trimmed(text.substr(0, end));
    Block block{keyword_named(name.substr(1)), part_of(line, name), {}, {}};
    if (block.keyword == nullptr)
      faults_.add(block.at, fmt::format("found {}, which is no keyword of Abaqus or CalculiX{}",
                                        shown(std::string(name)), nearest_keyword(name.substr(1))));
    auto rest = text.substr(std::min(end + 1, text.size()));
    bool goes_on = end < text.size() && rest.empty();
    for (;;) {
      while (!rest.empty()) {
        end = comma_in(rest);
        add_parameter(line, trimmed(rest.substr(0, end)), block);
        goes_on = end < rest.size() && trimmed(rest.substr(end + 1)).empty();
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
      if (!goes_on || !lines.goes_on() || !lines.next(line))
        break;
      rest = trimmed(line.text);
      goes_on = false;
    }
    if (block.is("INCLUDE"))
      return include(require_value(block, "INPUT", "the name of a file", faults_), depth);
    const auto* const input = block.find("INPUT");
    const bool takes_file =
        input != nullptr && block.keyword != nullptr && lists(block.keyword->takes, "INPUT");
    const auto data_file = takes_file ? input->value : Word{};
    source_.blocks.push_back(std::move(block));
    include(data_file, depth);
  }

  void include(const Word& name, int depth) {
    if (name.empty())
      return;
    if (depth >= most_nested_files || source_.texts.size() >= most_files)
      return faults_.add(name, fmt::format("found files that include one another {} deep, expected fewer",
                                           most_nested_files));
    const auto path = fs::path(*name.file).parent_path() / fs::path(std::string(name.text));
    try {
      read(file_content(path, path, "a text file"), path.string(), depth + 1);
    } catch (const InputError& error) {
      faults_.add(name, error.faults().front().text);
    }
  }

  Source& source_;
  Faults& faults_;
};

void drop_blank_ends(Source& source) {
  for (auto& block : source.blocks)
    while (!block.lines.empty() && is_blank(block.lines.back()))
      block.lines.pop_back();
}

std::vector<std::string> words_in(std::string_view list) {
  std::vector<std::string> words;
  while (!list.empty()) {
    const auto end = std::min(list.find(','), list.size());
    words.emplace_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return words;
}

} // namespace

const Parameter* Block::find(std::string_view key) const {
  const auto found = std::ranges::find(parameters, key, &Parameter::key);
  return found == parameters.end() ? nullptr : &*found;
}

void Faults::add(const Word& at, std::string text) {
  add(at.at(), std::move(text));
}

void Faults::add(const Location& at, std::string text) {
  constexpr std::size_t most_faults = 100;
  const auto same = [&](const Fault& other) {
    return other.text == text && to_string(other.at) == to_string(at);
  };
  if (std::ranges::any_of(faults_, same))
    return;
  if (faults_.size() < most_faults)
    faults_.push_back({at, std::move(text)});
  else
    ++more_;
}

void Faults::throw_if_any() {
  if (faults_.empty())
    return;
  std::ranges::stable_sort(faults_, {}, [](const Fault& fault) {
    return std::tuple(fault.at.file, fault.at.line, fault.at.column);
  });
  if (more_ > 0) {
    Fault last;
    last.at.file = faults_.front().at.file;
    last.text = fmt::format("and {} more faults after these", more_);
    faults_.push_back(std::move(last));
  }
  throw InputError(std::move(faults_));
}

Source read_source(const fs::path& path, Faults& faults) {
  return parse_source(file_content(path, path, "an .inp file of Abaqus or CalculiX"), path.string(), faults);
}

Source parse_source(std::string text, const std::string& name, Faults& faults) {
  Source source;
  Reader(source, faults).read(std::move(text), name, 0);
  drop_blank_ends(source);
  return source;
}

std::vector<Word> fields_of(const Line& line) {
  std::vector<Word> fields;
  auto rest = line.text;
  while (!rest.empty()) {
    const auto end = comma_in(rest);
    fields.push_back(part_of(line, unquoted(trimmed(rest.substr(0, end)))));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (!fields.empty() && fields.back().empty() && is_blank(line))
    fields.clear();
  return fields;
}

Word word_of(const Line& line) {
  return part_of(line, trimmed(line.text));
}

std::vector<Word> fields_at(const Block& block, std::size_t line) {
  return line < block.lines.size() ? fields_of(block.lines[line]) : std::vector<Word>{};
}

bool is_blank(const Line& line) {
  return line.text.find_first_not_of(blanks) == std::string_view::npos;
}

std::optional<std::int64_t> integer_in(std::string_view text) {
  text.remove_prefix(text.starts_with('+') ? 1 : 0);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    return std::nullopt;
  return value;
}

std::optional<double> number_in(std::string_view text) {
  text.remove_prefix(text.starts_with('+') ? 1 : 0);
  double value = 0;
  const auto* last = text.data() + text.size();
  auto [end, error] = std::from_chars(text.data(), last, value);
  if (error == std::errc() && end != last && (*end == 'D' || *end == 'd')) {
    std::string with_e(text);
    std::ranges::replace_if(
        with_e, [](char letter) { return letter == 'D' || letter == 'd'; }, 'E');
    const auto* with_e_last = with_e.data() + with_e.size();
    const auto again = std::from_chars(with_e.data(), with_e_last, value);
    if (again.ec != std::errc() || again.ptr != with_e_last)
      return std::nullopt;
  } else if (error != std::errc() || end != last) {
    return std::nullopt;
  }
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> require_number(const Word& word, std::string_view expected, Faults& faults,
                                     std::optional<double> absent) {
  if (word.empty() && absent)
    return absent;
  const auto value = number_in(word.text);
  if (!value)
    faults.add(word, fmt::format("found {}, expected {}, a number",
                                 word.empty() ? "nothing" : shown(std::string(word.text)), expected));
  return value;
}

std::optional<std::int64_t> require_integer(const Word& word, std::string_view expected, Faults& faults) {
  const auto value = integer_in(word.text);
  if (!value)
    faults.add(word, fmt::format("found {}, expected {}, a whole number",
                                 word.empty() ? "nothing" : shown(std::string(word.text)), expected));
  return value;
}

void check_parameters(const Block& block, Faults& faults) {
  const auto& row = *block.keyword;
  for (const auto& parameter : block.parameters) {
    if (lists(row.takes, parameter.key) || lists(row.ignores, parameter.key))
      continue;
    const auto known = words_in(row.takes);
    const auto nearest = nearest_word(parameter.key, known);
    faults.add(parameter.name,
               fmt::format("found the parameter {} of *{}, which has no counterpart in rubato{}",
                           shown(std::string(parameter.name.text)), row.name,
                           nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }
}

Word require_value(const Block& block, std::string_view key, std::string_view expected, Faults& faults) {
  const auto* const parameter = block.find(key);
  if (parameter != nullptr && !parameter->value.empty())
    return parameter->value;
  faults.add(parameter == nullptr ? block.at : parameter->name,
             fmt::format("found {} without {}=, expected {}", block.at.text, key, expected));
  auto nothing = parameter == nullptr ? block.at : parameter->name;
  nothing.text = nothing.text.substr(0, 0);
  return nothing;
}

Word field(const std::vector<Word>& fields, std::size_t place, const Word& otherwise) {
  if (place < fields.size())
    return fields[place];
  auto word = fields.empty() ? otherwise : fields.back();
  if (!fields.empty())
    word.column += static_cast<int>(word.text.size());
  word.text = word.text.substr(0, 0);
  return word;
}

} // namespace rubato::mesh::inp
