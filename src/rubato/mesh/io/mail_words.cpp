// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mail_words.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/file_content.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::mesh::mail {
namespace {

constexpr std::string_view separators = " ,\t\r\n\v\f";
constexpr std::string_view ends_of_words = " ,\t\r\n\v\f=%";
constexpr std::size_t line_width = 80;

bool is_separator(char letter) {
  return separators.find(letter) != std::string_view::npos;
}

} // namespace

Words::Words(const std::filesystem::path& path)
    : path_(path), text_(file_content(path, path, "a mesh file of Code_Aster")) {}

void Words::skip_line() {
  at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
  line_start_ = at_;
}

void Words::skip_to_word() {
  while (at_ < text_.size()) {
    if (text_[at_] == '\n' || text_[at_] == '%')
      skip_line();
    else if (is_separator(text_[at_]))
      ++at_;
    else
      return;
  }
}

Word Words::next() {
  skip_to_word();
  if (at_ == text_.size())
    return {};
  const auto length =
      text_[at_] == '=' ? 1 : std::min(text_.find_first_of(ends_of_words, at_), text_.size()) - at_;
  const auto word = Word(text_).substr(at_, length);
  at_ += length;
  if (at_ - line_start_ > line_width)
    refuse(word, fmt::format("found {} beyond column {}, where Code_Aster reads nothing, expected it on the "
                             "next line",
                             shown(std::string(word)), line_width));
  return word;
}

Word Words::next_on_line() {
  const auto at = at_, line_start = line_start_;
  skip_to_word();
  if (line_start_ == line_start && at_ < text_.size())
    return next();
  at_ = at;
  line_start_ = line_start;
  return {};
}

void Words::skip_lines(int count) {
  for (; count > 0 && at_ < text_.size(); --count)
    skip_line();
}

bool Words::begins_line(std::string_view word) const {
  auto rest = Word(text_).substr(at_);
  rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
  return rest.starts_with(word) &&
         (rest.size() == word.size() || ends_of_words.find(rest[word.size()]) != std::string_view::npos);
}

void Words::refuse(Word at, std::string text) const {
  const auto offset = at.empty() ? text_.size() : static_cast<std::size_t>(at.data() - text_.data());
  const auto line_start = offset == 0 ? std::string::npos : text_.rfind('\n', offset - 1);
  const auto column = offset - (line_start == std::string::npos ? 0 : line_start + 1) + 1;
  const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(offset), '\n');
  throw InputError(std::move(text), {path_.string(), static_cast<int>(line), static_cast<int>(column)});
}

int Words::line_of(Word word) const {
  return 1 + static_cast<int>(std::count(text_.data(), word.data(), '\n'));
}

} // namespace rubato::mesh::mail
