// SPDX-License-Identifier: LGPL-3.0-or-later
/// Boxes of hexahedra as lines of .inp files.
#pragma once

#include <fmt/format.h>

#include "computed.hpp"
#include "support/scratch_folder.hpp"
#include <array>
#include <fstream>
#include <string>

namespace rubato::test {

/// Nodes and elements of a regular grid, nodes numbered along x first.
struct Box {
  std::array<int, 3> cells;
  std::array<double, 3> size;
  double z = 0;  ///< of its bottom
  int first = 1; ///< number of its first node and element

  int node(int i, int j, int k) const { return first + i + (cells[0] + 1) * (j + (cells[1] + 1) * k); }

  std::string nodes() const {
    std::string text;
    for (int k = 0; k <= cells[2]; ++k)
      for (int j = 0; j <= cells[1]; ++j)
        for (int i = 0; i <= cells[0]; ++i)
          text += fmt::format("{}, {}, {}, {}\n", node(i, j, k), size[0] * i / cells[0],
                              size[1] * j / cells[1], z + size[2] * k / cells[2]);
    return text;
  }

  std::string elements() const {
    std::string text;
    for (int k = 0, e = first; k < cells[2]; ++k)
      for (int j = 0; j < cells[1]; ++j)
        for (int i = 0; i < cells[0]; ++i, ++e)
          text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", e, node(i, j, k), node(i + 1, j, k),
                              node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1),
                              node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1));
    return text;
  }

  /// The nodes of a layer of cells across an axis as lines of a set.
  std::string layer(int axis, int at) const {
    std::string text;
    for (int k = 0; k <= cells[2]; ++k)
      for (int j = 0; j <= cells[1]; ++j)
        for (int i = 0; i <= cells[0]; ++i)
          if (std::array{i, j, k}.at(static_cast<std::size_t>(axis)) == at)
            text += fmt::format("{}\n", node(i, j, k));
    return text;
  }
};

/// The studies of a file with this text, computed.
inline Computed computed_text(const std::string& text) {
  const ScratchFolder folder;
  std::ofstream(folder / "text.inp") << text;
  return Computed(inp::read_input(folder / "text.inp").runs);
}

} // namespace rubato::test
