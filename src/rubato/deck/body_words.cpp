// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/body_words.hpp"

#include "rubato/cell/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace rubato::deck {
namespace {

constexpr std::array cells_of_rectangles{CellType::tria3, CellType::tria6, CellType::tria7,
                                         CellType::quad4, CellType::quad8, CellType::quad9};
constexpr std::array cells_of_boxes{CellType::tetra4, CellType::tetra10, CellType::penta6, CellType::penta15,
                                    CellType::hexa8,  CellType::hexa20,  CellType::hexa27};

/// The two sides across each axis.
constexpr std::array<std::array<std::string_view, 2>, 3> sides{
    {{"left", "right"}, {"bottom", "top"}, {"back", "front"}}};

} // namespace

std::span<const CellType> cells_of(int dimension) {
  return dimension == 3 ? std::span<const CellType>(cells_of_boxes)
                        : std::span<const CellType>(cells_of_rectangles);
}

std::vector<std::string> cell_words(int dimension) {
  std::vector<std::string> words;
  for (const auto type : cells_of(dimension)) {
    std::string word(cell::topology(type).name);
    std::ranges::transform(word, word.begin(), [](unsigned char letter) { return std::tolower(letter); });
    words.push_back(std::move(word));
  }
  return words;
}

std::vector<std::string> side_words(int dimension) {
  std::vector<std::string> words;
  for (int axis = 0; axis < dimension; ++axis)
    for (const auto side : sides[static_cast<std::size_t>(axis)])
      words.emplace_back(side);
  return words;
}

std::vector<std::string> pair_words(int dimension) {
  std::vector<std::string> words;
  for (std::size_t a = 0; a < static_cast<std::size_t>(dimension); ++a)
    for (std::size_t b = a + 1; b < static_cast<std::size_t>(dimension); ++b)
      for (const auto first : sides[a])
        for (const auto second : sides[b])
          words.push_back(fmt::format("{}_{}", first, second));
  return words;
}

std::vector<std::string> corner_words(int dimension) {
  auto words = pair_words(2);
  if (dimension == 2)
    return words;
  std::vector<std::string> corners;
  for (const auto& word : words)
    for (const auto side : sides[2])
      corners.push_back(fmt::format("{}_{}", word, side));
  return corners;
}

} // namespace rubato::deck
