// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/svg.hpp"

#include <gtest/gtest.h>

#include <array>
#include <pugixml.hpp>

namespace rubato::plot::svg_test {
namespace {

pugi::xml_document parsed(Svg svg) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(std::move(svg).finish().c_str()));
  return document;
}

TEST(Svg, IsXmlWithItsSizeAndTitle) {
  const auto document = parsed(Svg({640, 480}, "a < b & \"c\""));
  const auto root = document.child("svg");
  EXPECT_EQ(root.attribute("width").as_int(), 640);
  EXPECT_EQ(root.attribute("height").as_int(), 480);
  EXPECT_STREQ(root.child_value("title"), "a < b & \"c\"");
}

TEST(Svg, WritesPlacesToAThousandthOfAPixel) {
  Svg svg({100, 100}, "");
  svg.polyline(std::array{Point{1.23456, 2}, Point{-0.0001, 40.5}}, {"#ff0000", 2, "4 2"});
  const auto document = parsed(std::move(svg));
  const auto line = document.child("svg").child("polyline");
  EXPECT_STREQ(line.attribute("points").value(), "1.235,2 0,40.5");
  EXPECT_STREQ(line.attribute("stroke").value(), "#ff0000");
  EXPECT_STREQ(line.attribute("stroke-dasharray").value(), "4 2");
}

TEST(Svg, TakesTextAsItIsButForSignsThatXmlHasNot) {
  Svg svg({100, 100}, "");
  svg.text({1, 2}, "µ < 0,3 & \"so\"\x01\nLamé");
  svg.text({1, 2}, "");
  const auto document = parsed(std::move(svg));
  EXPECT_STREQ(document.child("svg").child_value("text"), "µ < 0,3 & \"so\"  Lamé");
  EXPECT_FALSE(document.child("svg").child("text").next_sibling("text"));
}

TEST(Svg, GroupsCarryClassAndTitle) {
  Svg svg({100, 100}, "");
  svg.open_group("curve", "tip.y");
  svg.dot({1, 2}, 3, "#000000");
  svg.close_group();
  const auto document = parsed(std::move(svg));
  const auto group = document.child("svg").child("g");
  EXPECT_STREQ(group.attribute("class").value(), "curve");
  EXPECT_STREQ(group.child_value("title"), "tip.y");
  EXPECT_TRUE(group.child("circle"));
}

TEST(TextWidth, CountsLettersNotBytes) {
  EXPECT_EQ(text_width("µε", 10), text_width("mn", 10));
  EXPECT_EQ(cut_to_width("displacement", 10, 1000), "displacement");
  const auto cut = cut_to_width("ÄÖÜäöüßé", 10, text_width("12345", 10));
  EXPECT_EQ(cut, "ÄÖÜä…");
  EXPECT_LE(text_width(cut, 10), text_width("12345", 10));
}

} // namespace
} // namespace rubato::plot::svg_test
