// SPDX-License-Identifier: LGPL-3.0-or-later
/// The words of a generated body: its cells, and the places of its grid that may have names.
#pragma once

#include "rubato/core/cell_type.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::deck {

/// Types of cells that a rectangle (2) or a box (3) is made of, and their words: "hexa8".
std::span<const CellType> cells_of(int dimension);
std::vector<std::string> cell_words(int dimension);

/// "left", "right", … of the first `dimension` axes.
std::vector<std::string> side_words(int dimension);
/// Every pair of sides across two axes, "right_top".
std::vector<std::string> pair_words(int dimension);
/// Every corner, "right_top" or "right_top_back".
std::vector<std::string> corner_words(int dimension);

} // namespace rubato::deck
