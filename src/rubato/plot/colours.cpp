// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::plot {
namespace {

constexpr std::array<std::string_view, 6> line_colours{"#0072b2", "#d55e00", "#009e73",
                                                       "#cc79a7", "#e69f00", "#56b4e9"};
constexpr std::array<std::string_view, 5> line_dashes{"", "8 4", "2 3", "8 3 2 3", "14 4"};

using Colour = std::array<double, 3>; // red, green, blue, 0 to 255

/// viridis at equal distances.
constexpr std::array<Colour, 17> viridis{{{68, 1, 84},
                                          {72, 24, 106},
                                          {71, 45, 123},
                                          {66, 64, 134},
                                          {59, 82, 139},
                                          {51, 99, 141},
                                          {44, 114, 142},
                                          {38, 130, 142},
                                          {33, 145, 140},
                                          {31, 160, 136},
                                          {40, 174, 128},
                                          {63, 188, 115},
                                          {94, 201, 98},
                                          {132, 212, 75},
                                          {173, 220, 48},
                                          {216, 226, 25},
                                          {253, 231, 37}}};

} // namespace

LineStyle line_style(int colour, int dashes) {
  const auto round = static_cast<std::size_t>(colour) / line_colours.size();
  return {line_colours[static_cast<std::size_t>(colour) % line_colours.size()],
          line_dashes[(static_cast<std::size_t>(dashes) + round) % line_dashes.size()]};
}

int line_colour_count() {
  return static_cast<int>(line_colours.size());
}

std::string range_colour(double part) {
  const double place = std::clamp(part, 0.0, 1.0) * (viridis.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  const double rest = place - static_cast<double>(before);
  std::array<int, 3> mixed{};
  for (std::size_t i = 0; i < mixed.size(); ++i)
    mixed[i] = static_cast<int>(
        std::lround(viridis[before][i] + rest * (viridis[before + 1][i] - viridis[before][i])));
  return fmt::format("#{:02x}{:02x}{:02x}", mixed[0], mixed[1], mixed[2]);
}

} // namespace rubato::plot
