// SPDX-License-Identifier: LGPL-3.0-or-later
/// The studies that whole steps are measured on.
#pragma once

#include "rubato/deck/read.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::bench {

/// Run evol1 of a deck of cases/sdnl140, cells cut `refine` times, without fields and checks. Times in
/// seconds.
inline study::Study sdnl140(const std::string& deck_name, int refine, double step, double end) {
  const auto text = [](double value) {
    std::string digits(32, ' ');
    digits.resize(static_cast<std::size_t>(
        std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr - digits.data()));
    return digits;
  };
  const std::vector<deck::Setting> settings{{"mesh.refine", std::to_string(refine)},
                                            {"time.step", text(step)},
                                            {"time.end", text(end)},
                                            {"checks", ""},
                                            {"fields", ""}};
  const auto deck =
      deck::read_deck(std::filesystem::path(RUBATO_SOURCE_DIR) / "cases/sdnl140" / deck_name, settings);
  return *std::ranges::find(deck.runs, "evol1", &study::Study::name);
}

} // namespace rubato::bench
