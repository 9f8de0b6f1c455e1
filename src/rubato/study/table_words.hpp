// SPDX-License-Identifier: LGPL-3.0-or-later
/// The words of tables and of .frd files. Quantities have the names that CalculiX gives them.
#pragma once

#include "rubato/study/words.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::study {

inline constexpr std::array<Word<bool>, 2> frd_words{{{"ascii", false}, {"binary", true}}};

/// The key of a table for each place.
inline constexpr std::array<Word<TableOf>, 4> table_of_words{{{"nodes", TableOf::nodes},
                                                              {"cells", TableOf::cells},
                                                              {"faces", TableOf::faces},
                                                              {"zones", TableOf::zones}}};
inline constexpr std::array<Word<TableTotals>, 3> table_totals_words{
    {{"none", TableTotals::none}, {"also", TableTotals::also}, {"only", TableTotals::only}}};

inline constexpr std::array<std::string_view, 7> node_table_words{"U", "V", "A", "RF", "NT", "UR", "RM"};
inline constexpr std::array<std::string_view, 9> cell_table_words{"S",    "E",    "ME",   "PEEQ", "ENER",
                                                                  "ELSE", "ELKE", "EVOL", "COORD"};
inline constexpr std::array<std::string_view, 3> face_table_words{"SOF", "SOM", "SOAREA"};
inline constexpr std::array<std::string_view, 6> zone_table_words{"CDIS", "CSTR", "CNUM", "CF", "CFN", "CFS"};

constexpr std::span<const std::string_view> table_words(TableOf of) {
  switch (of) {
  case TableOf::nodes:
    return node_table_words;
  case TableOf::cells:
    return cell_table_words;
  case TableOf::faces:
    return face_table_words;
  case TableOf::zones:
    return zone_table_words;
  }
  return {};
}

/// Returns whether cells store half of stress times strain: ENER and ELSE are known.
inline bool stores_half_of_products(const Study& study) {
  return std::ranges::all_of(study.materials, [](const Material& material) {
    const bool elastic = material.law == LawKind::elastic || material.law == LawKind::orthotropic;
    return elastic && material.strain.value_or(StrainKind::small) == StrainKind::small;
  });
}

/// The words of all places.
inline std::vector<std::string> all_table_words() {
  std::vector<std::string> words;
  for (const auto& place : table_of_words)
    words.insert(words.end(), table_words(place.value).begin(), table_words(place.value).end());
  return words;
}

} // namespace rubato::study
