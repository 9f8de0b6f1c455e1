// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read_deck.hpp"

#include <iostream>
#include <iterator>
#include <vector>

namespace rubato::app {

bool is_standard_input(const std::filesystem::path& argument) {
  return argument == "-";
}

deck::Deck read_deck(const std::filesystem::path& argument, std::span<const std::string> settings,
                     std::span<const std::string> only) {
  std::vector<deck::Setting> changes;
  for (const auto& text : settings)
    changes.push_back(deck::parse_setting(text));
  if (!is_standard_input(argument))
    return deck::read_deck(argument, changes, only);
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  return deck::parse_deck(text, "<stdin>", changes, only);
}

} // namespace rubato::app
