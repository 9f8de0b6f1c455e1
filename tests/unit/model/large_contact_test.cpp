// SPDX-License-Identifier: LGPL-3.0-or-later
// Zones whose points may be too many to form what they do to one another are told before the first step.
#include "rubato/model/large_contact.hpp"
#include "rubato/model/model.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <string>
#include <vector>

namespace rubato::model::large_contact_test {
namespace {

/// Faces of the slave: 900.
constexpr const char* plates = R"(mesh:
  generate:
    - {name: lower, box: {from: [0, 0, 0], to: [1, 0.1, 1]}, divisions: [2, 1, 2], cells: hexa8,
       sides: {bottom: ground, top: lower_face}}
    - {name: upper, box: {from: [0, 0.1, 0], to: [1, 0.2, 1]}, divisions: [30, 1, 30], cells: hexa8,
       sides: {top: roof, bottom: upper_face}}
physics: solid
materials: {steel: {young: 2e11, poisson: 0.3, density: 7800}}
supports:
  - {on: ground, fix: [x, y, z]}
  - {on: roof, fix: [x, z], y: -0.01}
contact: {interface: {master: lower_face, slave: upper_face}}
time: {scheme: static, step: 1, end: 1}
)";

std::vector<std::string> notes_with(const std::string& integration) {
  return notes_on_large_contact(test::model_of(plates, {{"contact.interface.integration", integration}}));
}

TEST(LargeContact, IsToldWhereItsMatrixIsFormed) {
  const auto notes = notes_with("{gauss: 3}"); // 8,100 points of three components
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_NE(notes.front().find("contact zone 'interface': if all of its 8100 points touch at once, a step "
                               "takes 9.4 GB"),
            std::string::npos)
      << notes.front();
  EXPECT_NE(notes.front().find("'integration: mortar'"), std::string::npos) << notes.front();
}

TEST(LargeContact, IsOfNoConcernWithFewPointsOrWithoutTheMatrix) {
  EXPECT_TRUE(notes_with("{gauss: 2}").empty());
  EXPECT_TRUE(notes_with("mortar").empty());
  EXPECT_TRUE(notes_with("nodes").empty());
}

} // namespace
} // namespace rubato::model::large_contact_test
