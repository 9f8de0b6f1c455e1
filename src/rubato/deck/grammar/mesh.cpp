// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/body_words.hpp"
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/study/bounds.hpp"
#include "rubato/study/words.hpp"

#include <algorithm>

namespace rubato::deck::grammar {
namespace {

constexpr std::array dimensions{2, 3};

/// The words of both dimensions, none twice.
template <class Words> std::vector<std::string> of_both(const Words& words_of_dimension) {
  std::vector<std::string> words;
  for (const int dimension : dimensions)
    for (const auto& word : words_of_dimension(dimension))
      if (std::ranges::find(words, word) == words.end())
        words.push_back(word);
  return words;
}

/// A name of a group for each place of the grid.
Forms names_by_place(const std::string& title, const std::vector<std::string>& words) {
  std::vector<Key> keys;
  keys.reserve(words.size());
  for (const auto& word : words)
    keys.push_back({word, "name of the group there", name()});
  return map(title, std::move(keys));
}

Forms extent(const std::string& title) {
  return map(title, {{"from", "corner with the least coordinates [length]", coordinates(), true},
                     {"to", "opposite corner, greater on every axis [length]", coordinates(), true}});
}

Forms body() {
  return map(
      "a body that is a regular grid",
      {{"name", "name of the body and of its group of cells", name(), true},
       {"box", "extent of a body of solid", extent("a box")},
       {"rectangle", "extent of a body of plane_stress, plane_strain or axisymmetric", extent("a rectangle")},
       {"divisions", "cells along each axis",
        list(whole_number(study::bounds::divisions), 2, study::axis_words.size()), true},
       {"cells", "type of the cells; hexa8 of a box and quad4 of a rectangle when not given",
        word(of_both(cell_words))},
       {"sides", "names of groups by side", names_by_place("sides of a body", side_words(3))},
       {"edges", "names of groups by the two sides that meet, of a box",
        names_by_place("edges of a box", pair_words(3))},
       {"points", "names of groups by corner", names_by_place("corners of a body", of_both(corner_words))}});
}

} // namespace

Forms mesh() {
  return map(
      "the mesh: a file, or bodies that are generated",
      {{"file", "mesh file, relative to the folder of the deck", name()},
       {"name", "name of the mesh inside the file; its first one when not given", text()},
       {"generate", "bodies that are regular grids", list(body(), 1)},
       {"convert",
        "whether mid-edge nodes are removed (linear) or added (quadratic), with centres of faces and "
        "cells (full_quadratic)",
        word_of(study::conversion_words)},
       {"refine", "every edge is cut into that many parts; 1 when not given",
        whole_number(study::bounds::refine)},
       {"groups", "groups by name, made of what the mesh has when it is converted and refined", groups()}});
}

} // namespace rubato::deck::grammar
