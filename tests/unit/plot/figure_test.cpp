// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/figure.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>

namespace rubato::plot::figure_test {
namespace {

Figure one_panel(Curve curve) {
  return {.title = "title", .x_label = "t", .panels = {{"y", {std::move(curve)}}}};
}

pugi::xml_document drawn(const Figure& figure) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(to_svg(figure, {800, usual_height(figure)}).c_str()));
  return document;
}

pugi::xml_node group_named(pugi::xml_node parent, const char* name) {
  return parent.find_child_by_attribute("g", "class", name);
}

std::size_t points_of(pugi::xml_node line) {
  const std::string text = line.attribute("points").value();
  return text.empty() ? 0 : static_cast<std::size_t>(std::ranges::count(text, ' ')) + 1;
}

TEST(Figures, BreakTheLineWhereThereIsNoValue) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto document = drawn(one_panel({.label = "gap",
                                         .x = {0, 1, 2, 3, 4, 5, 6},
                                         .y = {0, 1, nothing, nothing, 1, nothing, 2},
                                         .style = line_style(0)}));
  const auto curve = group_named(group_named(document.child("svg"), "panel"), "curve");
  EXPECT_EQ(points_of(curve.child("polyline")), 2U);
  EXPECT_FALSE(curve.child("polyline").next_sibling("polyline"));
  EXPECT_EQ(std::distance(curve.children("circle").begin(), curve.children("circle").end()), 2)
      << "points that stand alone are dots";
}

TEST(Figures, HaveAPanelForEachKindAndNumbersBelowTheLowest) {
  Figure figure = one_panel({.label = "a", .x = {0, 1}, .y = {0, 1}, .style = line_style(0)});
  figure.panels.push_back({"z", {{.label = "b", .x = {0, 2}, .y = {0, 1e6}, .style = line_style(1)}}});
  const auto document = drawn(figure);
  std::vector<std::size_t> texts;
  for (const auto panel : document.child("svg").children("g")) {
    EXPECT_STREQ(panel.attribute("class").value(), "panel");
    const auto axis = group_named(panel, "x-axis");
    texts.push_back(
        static_cast<std::size_t>(std::distance(axis.children("text").begin(), axis.children("text").end())));
  }
  ASSERT_EQ(texts.size(), 2U);
  EXPECT_EQ(texts[0], 0U);
  EXPECT_GT(texts[1], 3U);
}

TEST(Figures, OfMillionsOfPointsStaySmall) {
  Curve curve{.label = "a", .style = line_style(0)};
  for (int i = 0; i < 1'000'000; ++i) {
    curve.x.push_back(i);
    curve.y.push_back(std::sin(i * 1e-5));
  }
  const auto figure = one_panel(std::move(curve));
  const auto document = drawn(figure);
  const auto line = group_named(group_named(document.child("svg"), "panel"), "curve").child("polyline");
  EXPECT_LT(points_of(line), 50'000U);
  EXPECT_GT(points_of(line), 5'000U);
}

TEST(Figures, AreRefusedWhereTheyHaveNoRoom) {
  const auto figure = one_panel({.label = "a", .x = {0, 1}, .y = {0, 1}, .style = line_style(0)});
  EXPECT_EQ(test::fault_of([&] {
              to_svg(figure, {800, 100});
            }),
            "found a size of 800 x 100 pixels, which has no room for 1 panel of curves");
  EXPECT_EQ(test::fault_of([&] {
              to_svg(figure, {90, 400});
            }),
            "found a size of 90 x 400 pixels, which has no room for 1 panel of curves");
}

} // namespace
} // namespace rubato::plot::figure_test
