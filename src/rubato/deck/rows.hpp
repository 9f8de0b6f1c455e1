// SPDX-License-Identifier: LGPL-3.0-or-later
/// Reading the numbers of a row of a table, and refusing those of the other rows.
#pragma once

#include "rubato/deck/values.hpp"
#include "rubato/study/number.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::deck {

/// "hht takes it", "hht and newmark take it".
std::string takers_text(std::vector<std::string_view> names);

/// The rows that have a number of that key.
template <class Rows> std::string takers_of(const Rows& rows, std::string_view key) {
  std::vector<std::string_view> names;
  for (const auto& row : rows)
    if (study::takes(row, key))
      names.push_back(row.name);
  return takers_text(std::move(names));
}

/// A key that other rows take: a fault that names them. `noun`: "the scheme", what a row is.
void refuse_of_others(MapReader& map, std::string_view key, std::string_view noun, std::string_view name,
                      std::string_view takers);

/// Refuses the numbers that only other rows take.
template <class Rows, class Row>
void refuse_numbers_of_others(MapReader& map, const Rows& rows, const Row& row, std::string_view noun) {
  for (const auto& other : rows)
    for (const auto& number : other.numbers)
      if (!study::takes(row, number.key))
        refuse_of_others(map, number.key, noun, row.name, takers_of(rows, number.key));
}

/// Reads what the row takes, and refuses what only other rows take.
template <class Rows, class Row, class Record>
void read_numbers_of(MapReader& map, const Rows& rows, const Row& row, std::string_view noun,
                     Record& record) {
  refuse_numbers_of_others(map, rows, row, noun);
  for (const auto& number : row.numbers) {
    double value = 0;
    if (read(number.required ? map.require(number.key) : map.find(number.key), value))
      number.set(record, value);
  }
}

/// What a row takes is not known, as its word is none: no key of any row is unknown, no rule about one can be
/// judged.
template <class Rows> void pass_numbers(MapReader& map, const Rows& rows) {
  for (const auto& row : rows)
    for (const auto& number : row.numbers) {
      map.find(number.key);
      map.spoil(number.key);
    }
}

} // namespace rubato::deck
