// SPDX-License-Identifier: LGPL-3.0-or-later
// The two sides of sets of faces that meet each other.
#include "rubato/contact/self_pairs.hpp"
#include "rubato/contact/two_sides.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rubato::contact::two_sides_test {
namespace {

/// Six faces of a fold: 0, 1, 2 meet 5, 4, 3; neighbours follow each other round the fold at 2, 3.
std::vector<Joint> fold() {
  return {{0.1, true, 0, 5},  {0.2, true, 1, 4},  {0.3, true, 2, 3},  {0.2, false, 0, 1},
          {0.3, false, 1, 2}, {0.3, false, 2, 3}, {0.3, false, 3, 4}, {0.2, false, 4, 5}};
}

TEST(TwoSides, ChangeWhereAFoldIsFarthestFromContact) {
  const auto sides = two_sides(6, fold());
  for (const std::size_t face : {1U, 2U}) {
    EXPECT_EQ(sides[face].other, sides[0].other) << face;
    EXPECT_EQ(sides[face].set, sides[0].set) << face;
  }
  for (const std::size_t face : {3U, 4U, 5U}) {
    EXPECT_NE(sides[face].other, sides[0].other) << face;
    EXPECT_EQ(sides[face].set, sides[0].set) << face;
  }
}

TEST(TwoSides, OfFacesThatNothingJoinsAreSetsOfTheirOwn) {
  const auto sides = two_sides(3, {{1, true, 0, 2}});
  EXPECT_EQ(sides[0].set, sides[2].set);
  EXPECT_NE(sides[0].set, sides[1].set);
}

/// Three faces that all meet each other have no two sides: what is farthest apart is given up.
TEST(TwoSides, OfThreeThatMeetAreThoseOfTheNearest) {
  const auto sides = two_sides(3, {{3, true, 0, 1}, {1, true, 1, 2}, {2, true, 0, 2}});
  EXPECT_NE(sides[1].other, sides[2].other);
  EXPECT_NE(sides[0].other, sides[2].other);
  EXPECT_EQ(sides[0].other, sides[1].other);
}

TEST(TheFartherSide, IsThatWithTheCentreFartherAlongTheAxisOfTheirDistance) {
  std::vector<FlatFace> faces(6);
  for (std::size_t f = 0; f < 6; ++f) {
    faces[f].centre = {f < 3 ? static_cast<double>(f) : 5.0 - static_cast<double>(f), f < 3 ? -0.1 : 0.1, 0};
    faces[f].size = 0.5;
  }
  const auto sides = two_sides(6, fold());
  EXPECT_EQ(farther_sides(sides, faces), (std::vector<char>{0, 0, 0, 1, 1, 1}));
  for (auto& face : faces)
    face.centre.y() *= -1;
  EXPECT_EQ(farther_sides(sides, faces), (std::vector<char>{1, 1, 1, 0, 0, 0}));
}

} // namespace
} // namespace rubato::contact::two_sides_test
