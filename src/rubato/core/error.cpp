// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace rubato {
namespace {

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const auto& fault : faults) {
    const auto place = to_string(fault.at);
    text += fmt::format("{}{}{}{}", text.empty() ? "" : "\n", place, place.empty() ? "" : ": ", fault.text);
  }
  return text;
}

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

std::string to_string(const Location& at) {
  if (at.line <= 0)
    return at.file;
  return at.column > 0 ? fmt::format("{}:{}:{}", at.file, at.line, at.column)
                       : fmt::format("{}:{}", at.file, at.line);
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(joined(faults)), faults_(std::move(faults)) {}

InputError::InputError(std::string text, Location at)
    : InputError(std::vector<Fault>{{std::move(at), std::move(text)}}) {}

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

} // namespace rubato
