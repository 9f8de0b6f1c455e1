// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/results/study_difference.hpp"
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>

#include "support/two_blocks.hpp"
#include <string>
#include <vector>

namespace rubato::results::study_difference_test {
namespace {

std::string echo(const std::vector<deck::Setting>& changes = {}) {
  return study::to_json(deck::parse_deck(test::two_blocks, "deck.yaml", changes).runs.front());
}

struct Change {
  std::string path;
  std::string value;
  std::string difference; ///< how it begins; empty: a run may be resumed with it
  bool same_results;      ///< whether a run without it has its results
};

std::ostream& operator<<(std::ostream& out, const Change& change) {
  return out << change.path;
}

class ChangedStudy : public testing::TestWithParam<Change> {};

TEST_P(ChangedStudy, IsAnotherRunOrIsNot) {
  const auto& change = GetParam();
  const auto now = echo({{change.path, change.value}});
  ASSERT_NE(now, echo()) << "nothing changed";
  const auto difference = study_difference(echo(), now);
  EXPECT_EQ(difference.has_value(), !change.difference.empty()) << difference.value_or("no difference");
  EXPECT_TRUE(difference.value_or("").starts_with(change.difference)) << difference.value_or("");
  EXPECT_EQ(same_results_expected(echo(), now), change.same_results);
}

INSTANTIATE_TEST_SUITE_P(
    By, ChangedStudy,
    testing::Values(Change{"title", "other", "", true}, Change{"checkpoint", "{every: 3}", "", true},
                    Change{"checks", "[{probe: end.y, at: 4e-4, reference: 1, tolerance: 0.1}]", "", true},
                    Change{"time.end", "8e-4", "", false}, Change{"time.on_failure", "{cut: 3}", "", false},
                    Change{"newton.residual", "1e-9", "", false},
                    Change{"contact.interface.friction", "0.3",
                           "contact.interface.friction was 0.2 and is 0.3 now", false},
                    Change{"time.step", "2e-4", "time.step was 0.0001 and is 0.0002 now", false},
                    Change{"thickness", "2", "thickness was 1", false},
                    Change{"loads.0.nodal_force.y", "-2e7", "loads.0.", false},
                    Change{"springs", "[{on: tip, x: 1e3}]", "springs.0 was not there and is ", false}));

TEST(SameStudy, HasNoDifference) {
  EXPECT_EQ(study_difference(echo(), echo()), std::nullopt);
  EXPECT_TRUE(same_results_expected(echo(), echo()));
}

} // namespace
} // namespace rubato::results::study_difference_test
