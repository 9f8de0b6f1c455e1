// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the parts of the echo share. Only its sources include this.
#pragma once

#include "rubato/study/words.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace rubato::study {

using Json = nlohmann::ordered_json;

template <class E, std::size_t N> std::string word(const std::array<Word<E>, N>& table, E value) {
  return std::string(word_of(table, value));
}

Json first(const std::array<double, 3>& numbers, int count);

void put_name(Json& map, const char* key, const std::string& name);

void put(Json& map, std::string_view key, double value);
void put(Json& map, std::string_view key, bool value);

template <class T> void put_optional(Json& map, const char* key, const std::optional<T>& value) {
  if (value)
    put(map, key, *value);
}

/// The numbers that a row of a table takes.
template <class Row, class Record> void put_numbers(Json& map, const Row& row, const Record& record) {
  for (const auto& number : row.numbers)
    if (const auto value = number.get(record))
      put(map, number.key, *value);
}

/// What a law has that is no plain number, and the strain and formulation where they are given.
void put_law_words(Json& map, const Material& material);

/// The mesh as a deck has it.
Json echo(const MeshSource& mesh, int dimension);
/// Results as a deck has them.
Json echo(const Cut& cut, int dimension);
Json echo(const Probe& probe, int dimension);
Json echo(const FieldOutput& fields);
Json echo(const CheckpointOutput& checkpoint);
Json echo(const Check& check);

} // namespace rubato::study
