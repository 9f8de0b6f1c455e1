// SPDX-License-Identifier: LGPL-3.0-or-later
/// Numbers that only some rows of a table take: those of a time scheme, of a material law. Deck, rules and
/// echo read them from the row.
#pragma once

#include "rubato/study/range.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

namespace rubato::study {

template <class Record> struct Number {
  std::string_view key;     ///< in a deck and in the echo
  std::string_view meaning; ///< with the unit in brackets, as editors show it
  Range range;
  bool required; ///< a deck must give it
  std::optional<double> (*get)(const Record&);
  void (*set)(Record&, double);
};

/// The number at a path of members, a double or an optional one: `number<Study, &Study::newton,
/// &NewtonSettings::residual>("residual", "largest residual force", between(0, 1))`.
template <class Record, auto... Path>
constexpr Number<Record> number(std::string_view key, std::string_view meaning, Range range,
                                bool required = false) {
  return {.key = key,
          .meaning = meaning,
          .range = range,
          .required = required,
          .get = [](const Record& record) -> std::optional<double> { return (record.*....*Path); },
          .set = [](Record& record, double value) { (record.*....*Path) = value; }};
}

/// Whether a row of a table has a number of that key.
template <class Row> constexpr bool takes(const Row& row, std::string_view key) {
  return std::ranges::any_of(row.numbers, [&](const auto& number) { return number.key == key; });
}

} // namespace rubato::study
