// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/grid_place.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

namespace rubato::mesh {
namespace {

constexpr std::array<std::array<std::string_view, 2>, 3> side_names{
    {{"left", "right"}, {"bottom", "top"}, {"back", "front"}}};

bool set_side(GridPlace& place, const std::string& word, int dimension) {
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis)
    for (std::size_t end = 0; end < 2; ++end)
      if (word == side_names[axis][end] && place[axis] == 0) {
        place[axis] = end == 0 ? -1 : 1;
        return true;
      }
  return false;
}

int side_count(const GridPlace& place) {
  return 3 - static_cast<int>(std::ranges::count(place, 0));
}

std::string name_of(const GridPlace& place) {
  std::string name;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (place[axis] != 0) {
      name += name.empty() ? "" : "_";
      name += side_names[axis][place[axis] < 0 ? 0 : 1];
    }
  return name;
}

} // namespace

std::optional<GridPlace> grid_place(const std::string& name, int dimension, int sides) {
  GridPlace place{};
  std::istringstream words(name);
  for (std::string word; std::getline(words, word, '_');)
    if (!set_side(place, word, dimension))
      return std::nullopt;
  if (side_count(place) != sides)
    return std::nullopt;
  return place;
}

std::vector<std::string> grid_place_names(int dimension, int sides) {
  std::vector<std::string> names;
  const int depth = dimension == 3 ? 1 : 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -depth; z <= depth; ++z)
        if (const GridPlace place{x, y, z}; side_count(place) == sides)
          names.push_back(name_of(place));
  return names;
}

} // namespace rubato::mesh
