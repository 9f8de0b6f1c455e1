// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a value of a deck may look like: its kind, its words, its keys. The reader looks for declared keys
/// only, the schema is written from the same declarations.
#pragma once

#include "rubato/study/range.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::deck::grammar {

struct Form;
struct Key;
/// A value has one of these forms.
using Forms = std::vector<Form>;

struct Form {
  enum class Kind {
    number,
    whole_number,
    truth,      ///< true or false
    word,       ///< one of `words`
    name,       ///< any word that is not empty
    text,       ///< any word
    expression, ///< a number, or an expression of place and time
    list,
    map,  ///< with the keys that are declared
    named ///< a map whose keys are names that the user chooses
  };
  static constexpr auto any_count = std::numeric_limits<std::size_t>::max();

  Kind kind = Kind::text;
  study::Range range{};           ///< of numbers, also of those that may be expressions
  std::vector<std::string> words; ///< of a word
  Forms of{};                     ///< of each item of a list, of each entry of a named map
  std::size_t least = 0;          ///< items of a list
  std::size_t most = any_count;   ///< items of a list, keys of a map in a list
  std::string title;              ///< of a map: what it describes
  std::vector<Key> keys;          ///< of a map
};

struct Key {
  std::string name;
  std::string meaning;   ///< with the unit in brackets
  Forms forms{};         ///< none of a key that the reader refuses with a reason
  bool required = false; ///< in any case; judged where nothing is laid over the map
};

Forms number(const study::Range& range = {});
Forms whole_number(const study::Range& range = {});
Forms truth();
Forms word(std::vector<std::string> words);
Forms name();
/// One name or a list of them.
Forms names();
Forms text();
Forms expression();
Forms list(Forms items, std::size_t least = 0, std::size_t most = Form::any_count);
Forms map(std::string title, std::vector<Key> keys);
Forms named(Forms entries);
Forms either(Forms one, Forms other);
/// A number within a range, an expression, a table along an axis, or a field of a file.
Forms field_value(const study::Range& range = {});
/// A value, or a map of it and the function of time that multiplies it.
Forms varying(Forms value);
/// A displacement, or a map of it or of the velocity or acceleration that it follows from, and the function.
Forms motion(Forms value);
/// x, y, z.
std::vector<Key> components(const std::string& meaning, const Forms& forms);
/// Coordinates of a point or a direction.
Forms coordinates();

/// The accepted words of a table.
template <class Table> Forms word_of(const Table& table) {
  std::vector<std::string> words;
  for (const auto& entry : table)
    if (entry.accepted)
      words.emplace_back(entry.text);
  return word(std::move(words));
}

/// What the range of a number makes of it: number or field_value.
using FormsOfRange = Forms (*)(const study::Range& range);
/// Adds the key of a number, or widens the bounds of the one there is.
void add_number(std::vector<Key>& keys, std::string_view name, std::string_view meaning,
                const study::Range& range, FormsOfRange forms_of_range);
/// A key for each number that some rows of a table take, with the bounds of all of them together.
template <class Rows> std::vector<Key> numbers_of(const Rows& rows, FormsOfRange forms_of_range = number) {
  std::vector<Key> keys;
  for (const auto& row : rows)
    for (const auto& entry : row.numbers)
      add_number(keys, entry.key, entry.meaning, entry.range, forms_of_range);
  return keys;
}

/// Both after one another.
std::vector<Key> joined(std::vector<Key> one, std::vector<Key> other);

/// The key's forms; null when no map among the forms has the key.
const Forms* forms_of(const Forms& forms, std::string_view key);
/// The forms of a list's items, or of the entries of a named map; null when there is neither.
const Forms* forms_of_each(const Forms& forms, Form::Kind kind);

} // namespace rubato::deck::grammar
