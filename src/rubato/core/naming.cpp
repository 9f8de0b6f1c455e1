// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/naming.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace rubato {
namespace {

/// Levenshtein distance that does not see the case of letters.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const bool same =
          std::tolower(static_cast<unsigned char>(a[i])) == std::tolower(static_cast<unsigned char>(b[j]));
      const auto replaced = diagonal + (same ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, replaced});
    }
  }
  return row.back();
}

} // namespace

std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  // A word further away than half its length is another word, not a slip of the keyboard.
  std::size_t best_distance = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const auto& candidate : candidates) {
    const auto distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string shown(const std::string& word) {
  constexpr std::size_t longest = 60;
  if (word.size() <= longest)
    return fmt::format("'{}'", word);
  auto end = longest;
  const auto inside_character = [&](std::size_t i) {
    return (static_cast<unsigned char>(word[i]) & 0xC0U) == 0x80U;
  };
  while (end > 0 && inside_character(end))
    --end;
  return fmt::format("'{}…'", word.substr(0, end));
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const auto nearest = nearest_word(word, candidates);
  if (!nearest.empty())
    return fmt::format("; did you mean '{}'?", nearest);
  return candidates.empty() ? "" : fmt::format("; expected one of {}", fmt::join(candidates, ", "));
}

std::string joined(const std::vector<std::string>& words, const std::string& between) {
  return fmt::format("{}", fmt::join(words, between));
}

bool is_name(const std::string& text) {
  const auto fits = [](char letter) {
    const auto byte = static_cast<unsigned char>(letter);
    return byte >= 0x80 || std::isalnum(byte) != 0 || letter == '_' || letter == '-';
  };
  constexpr std::size_t longest = 100; // with its suffix still a file name
  return !text.empty() && text.size() <= longest && std::ranges::all_of(text, fits);
}

} // namespace rubato
