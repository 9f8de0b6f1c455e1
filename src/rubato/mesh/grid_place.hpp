// SPDX-License-Identifier: LGPL-3.0-or-later
/// Names of places on the boundary of a box: "left", "right_top", "right_top_back".
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rubato::mesh {

/// −1 at the lower and +1 at the upper end of each axis, 0 anywhere along it: left is (−1, 0, 0).
using GridPlace = std::array<int, 3>;

/// The place where `sides` sides of a box (dimension 3) or rectangle (2) meet: left, right (x), bottom, top
/// (y), back, front (z: back is the lower end), joined by "_" in any order. Nothing when the name means no
/// such place.
std::optional<GridPlace> grid_place(const std::string& name, int dimension, int sides);

/// Every such name, each once.
std::vector<std::string> grid_place_names(int dimension, int sides);

} // namespace rubato::mesh
