// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the project only: a .mail file word by word.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rubato::mesh::mail {

/// A part of the file's text; empty at its end.
using Word = std::string_view;

/// The whole file and a position in it. Blanks and commas separate words, '=' is a word of its own, '%'
/// begins a comment. Words refer to the text that this object holds.
class Words {
public:
  explicit Words(const std::filesystem::path& path);
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;

  /// The next word. Throws InputError for one that reaches beyond column 80.
  Word next();
  /// The next word when it stands on the line of the last one, else an empty word without moving.
  Word next_on_line();
  /// Moves to the beginning of the line `count` lines further.
  void skip_lines(int count);
  /// Whether the rest of the line begins with that word, without moving.
  bool begins_line(std::string_view word) const;
  bool is_at_end() const { return at_ == text_.size(); }

  /// Throws InputError at the place of the word; at the file's end when the word is empty.
  [[noreturn]] void refuse(Word at, std::string text) const;
  /// From 1.
  int line_of(Word word) const;

private:
  void skip_to_word();
  void skip_line();

  std::filesystem::path path_;
  std::string text_;
  std::size_t at_ = 0;
  std::size_t line_start_ = 0;
};

} // namespace rubato::mesh::mail
