// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/echo_json.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace rubato::study {

Json first(const std::array<double, 3>& numbers, int count) {
  return std::vector<double>(numbers.begin(), numbers.begin() + count);
}

void put_name(Json& map, const char* key, const std::string& name) {
  if (!name.empty())
    map[key] = name;
}

void put(Json& map, std::string_view key, double value) {
  map[std::string(key)] = value;
}

void put(Json& map, std::string_view key, bool value) {
  map[std::string(key)] = value;
}

} // namespace rubato::study
