// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace rubato::deck {
namespace {

constexpr std::size_t largest_text = std::size_t{8} << 20U;

/// Bytes of the UTF-8 character that starts `text`; 0 when none does (RFC 3629: no overlong forms, no
/// surrogates).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto first = byte(0);
  if (first < 0x80)
    return 1;
  const std::size_t length = first >= 0xC2 && first <= 0xDF   ? 2
                             : first >= 0xE0 && first <= 0xEF ? 3
                             : first >= 0xF0 && first <= 0xF4 ? 4
                                                              : 0;
  if (length == 0 || text.size() < length)
    return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0U) != 0x80U)
      return 0;
  const bool overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool surrogate = first == 0xED && byte(1) > 0x9F;
  const bool beyond = first == 0xF4 && byte(1) > 0x8F;
  return overlong || surrogate || beyond ? 0 : length;
}

struct Flaw {
  std::size_t offset;
  std::string text;
};

std::optional<Flaw> flaw_of_line(std::string_view line) {
  for (std::size_t i = 0; i < line.size();) {
    const auto length = character_length(line.substr(i));
    const auto code = static_cast<unsigned char>(line[i]);
    if (length == 0)
      return Flaw{i, fmt::format("found byte 0x{:02x}, which is not UTF-8 text", code)};
    const bool ends_line = code == '\r' && i + 1 == line.size();
    if ((code < 0x20 && code != '\t' && !ends_line) || code == 0x7F)
      return Flaw{i, fmt::format("found control character 0x{:02x}, expected plain text", code)};
    i += length;
  }
  const auto word = line.find_first_not_of(" \t\r");
  const auto tab = line.find('\t');
  if (word != std::string_view::npos && line[word] != '#' && tab < word)
    return Flaw{tab, "found a tab before the first word of the line; YAML is indented with blanks"};
  return std::nullopt;
}

bool says_something(std::string_view line) {
  const auto word = line.find_first_not_of(" \t\r");
  return word != std::string_view::npos && line[word] != '#';
}

} // namespace

bool is_readable(std::string_view text, const std::string& file, Faults& faults) {
  if (text.size() > largest_text) {
    faults.add({file},
               fmt::format("found {} bytes, expected a deck of at most {}", text.size(), largest_text));
    return false;
  }
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark))
    text.remove_prefix(byte_order_mark.size());
  bool good = true;
  bool empty = true;
  for (int number = 1; !text.empty(); ++number) {
    const auto line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    empty = empty && !says_something(line);
    if (const auto flaw = flaw_of_line(line)) {
      faults.add({file, number, static_cast<int>(flaw->offset) + 1}, flaw->text);
      good = false;
    }
  }
  if (empty && good)
    faults.add({file}, "found no deck: the text is empty");
  return good && !empty;
}

} // namespace rubato::deck
