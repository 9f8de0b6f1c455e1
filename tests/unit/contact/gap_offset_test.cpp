// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/gap_offset.hpp"
#include "rubato/core/error.hpp"

#include <gtest/gtest.h>

namespace rubato::contact::gap_offset_test {
namespace {

using Eigen::Vector3d;
using study::Field;
using study::Formula;

const Vector3d here(0.5, 2, 0);
const std::map<std::string, Function> functions{{"ramp", {{0, 1}, {0, 1}}}};

GapOffset offset_of(const Field& gap, const Field& interference) {
  study::ContactZone zone;
  zone.gap = gap;
  zone.interference = interference;
  return make_gap_offset(zone, functions, "contact.a");
}

TEST(AGapOffset, IsTheGapLessTheInterferenceOfThePlace) {
  EXPECT_TRUE(offset_of({}, {}).terms.empty()) << "a zone without one has nothing to compute";
  EXPECT_EQ(offset_of(0.25, 0.125).at(here, 0), 0.125);
  EXPECT_EQ(offset_of({0.25, "ramp"}, {}).at(here, 0.5), 0.125);
  EXPECT_EQ(offset_of(Formula{"x+y"}, Formula{"x"}).at(here, 0), 2);
  EXPECT_EQ(offset_of({Formula{"x+y"}, "ramp"}, Formula{"x*t"}).at(here, 0.5), 1);
  EXPECT_EQ(offset_of(Formula{"x+y"}, Formula{"x"}).overlap_at(here, 0), 0.5);
}

TEST(AGapOffset, OfAUniformExpressionHasTheBitsOfTheNumber) {
  for (const double t : {0.1, 0.3, 0.7})
    EXPECT_EQ(offset_of({Formula{"1e-3"}, "ramp"}, Formula{"2e-5"}).at(here, t),
              offset_of({1e-3, "ramp"}, 2e-5).at(here, t));
}

TEST(AGapOffset, ChangesWhereItsExpressionHasTimeOrItsFunctionDoes) {
  EXPECT_FALSE(offset_of(Formula{"x"}, {}).moves());
  EXPECT_EQ(offset_of(Formula{"x"}, {}).change(here, 0, 1), 0);
  EXPECT_TRUE(offset_of(Formula{"x*t"}, {}).moves());
  EXPECT_EQ(offset_of(Formula{"x*t"}, {}).change(here, 1, 3), 1);
  EXPECT_TRUE(offset_of({}, {Formula{"x"}, "ramp"}).moves());
}

TEST(AGapOffset, RefusesInterferencesThatSetApart) {
  const auto offset = offset_of({}, Formula{"1-x"});
  EXPECT_EQ(offset.at(here, 0), -0.5);
  try {
    offset.at(Vector3d(2, 0, 0), 0.25);
    ADD_FAILURE() << "an interference of -1";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().front().path, "contact.a.interference");
    EXPECT_EQ(error.faults().front().text,
              "contact.a.interference: found -1 at x = 2, y = 0, z = 0, t = 0.25, an interference is a "
              "positive overlap, expected a gap, which sets surfaces apart");
  }
}

} // namespace
} // namespace rubato::contact::gap_offset_test
