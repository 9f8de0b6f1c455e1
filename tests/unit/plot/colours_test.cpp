// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/colours.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>
#include <utility>

namespace rubato::plot::colours_test {
namespace {

/// Of "#rrggbb", 0 to 255 (ITU-R BT.709).
double brightness(const std::string& colour) {
  const auto part = [&](std::size_t at) { return std::strtol(colour.substr(at, 2).c_str(), nullptr, 16); };
  return 0.2126 * static_cast<double>(part(1)) + 0.7152 * static_cast<double>(part(3)) +
         0.0722 * static_cast<double>(part(5));
}

TEST(Colours, OfManyCurvesAreAllDifferentWithTheirDashes) {
  std::set<std::pair<std::string_view, std::string_view>> styles;
  const int count = 5 * line_colour_count();
  for (int i = 0; i < count; ++i) {
    const auto style = line_style(i);
    styles.emplace(style.colour, style.dashes);
  }
  EXPECT_EQ(styles.size(), static_cast<std::size_t>(count));
  EXPECT_EQ(line_style(0).dashes, "");
  EXPECT_EQ(line_style(2, 1).colour, line_style(2).colour);
  EXPECT_NE(line_style(2, 1).dashes, line_style(2).dashes);
}

TEST(Colours, OfARangeBecomeBrighterAllAlong) {
  EXPECT_EQ(range_colour(0), "#440154");
  EXPECT_EQ(range_colour(1), "#fde725");
  EXPECT_EQ(range_colour(-1), range_colour(0));
  EXPECT_EQ(range_colour(2), range_colour(1));
  for (int i = 0; i < 100; ++i)
    EXPECT_LE(brightness(range_colour(i / 100.0)), brightness(range_colour((i + 1) / 100.0))) << i;
}

} // namespace
} // namespace rubato::plot::colours_test
