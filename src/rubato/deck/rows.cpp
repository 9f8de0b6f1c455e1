// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rubato::deck {

std::string takers_text(std::vector<std::string_view> names) {
  const auto last = names.back();
  names.pop_back();
  return names.empty() ? fmt::format("{} takes it", last)
                       : fmt::format("{} and {} take it", fmt::join(names, ", "), last);
}

void refuse_of_others(MapReader& map, std::string_view key, std::string_view noun, std::string_view name,
                      std::string_view takers) {
  map.refuse(key,
             fmt::format("{} {} takes no {}, {}; a run removes it by '{}: ~'", noun, name, key, takers, key));
}

} // namespace rubato::deck
