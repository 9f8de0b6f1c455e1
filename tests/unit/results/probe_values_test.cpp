// SPDX-License-Identifier: LGPL-3.0-or-later
// Probes and checks of stresses, contact, energies and resultants, in a run as a user writes it.
#include "rubato/deck/read.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/scratch_folder.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::results::probe_values_test {
namespace {

/// A block of height 1 that is pressed by 1000 onto a plane: σ_yy = −1000 in the middle, p = 1000 in the
/// mean.
const std::string probes = R"(
probes:
  middle: {on: top, take: mean, field: stress}
  equivalent: {on: top, take: max, field: von_mises}
  peak: {on: under, take: max, field: contact_pressure}
  travel: {on: under, take: max, field: contact_cumulated_slip}
  work: {on: under, take: sum, field: contact_friction_work}
  state: {on: under, take: max, field: contact_status}
  slip: {on: under, take: max, field: contact_slip}
  support: {on: ground, take: sum, field: reaction}
  ground: {section: {on: ground, cells: plane, point: [0, -1], normal: [0, -1]}}
  held: {on: ground, field: reaction}
  rest: {minus: [support, held]}
checks:
  - {probe: middle.yy, at: 1, reference: -1000, tolerance: 0.3}
  - {probe: work, over: max, reference: 1e-3, tolerance: 1, kind: absolute}
  - {energy: friction, at: 1, reference: 1e-3, tolerance: 1, kind: absolute}
  - {resultant: foot.normal, at: 1, reference: 1000, tolerance: 1e-6}
  - {resultant: foot.force.y, over: min, reference: 1000, tolerance: 1e-9}
  - {probe: support.y, at: 1, reference: 1000, tolerance: 1e-9}
  - {probe: peak, over: max_magnitude, reference: 1000, tolerance: 9}
  - {probe: ground.normal, at: 1, reference: -1000, tolerance: 1e-9}
  - {probe: ground.y, over: max, reference: 1000, tolerance: 1e-9}
  - {probe: rest.y, over: max_magnitude, reference: 0, tolerance: 1e-12, kind: absolute}
)";

class ProbesOfABlock : public testing::Test {
protected:
  ProbesOfABlock() {
    const std::vector<deck::Setting> dragged{{"supports.1.x.value", "1e-4"}};
    result_ =
        run::run_study(deck::parse_deck(test::block_on_plane + probes, "deck.yaml", dragged).runs.front(),
                       folder_.path(), {});
  }

  test::ScratchFolder folder_;
  run::RunResult result_;
};

TEST_F(ProbesOfABlock, HaveAColumnAComponentAndOneForScalars) {
  const auto table = read_csv(folder_ / "probes.csv");
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"t",         "middle.xx", "middle.yy",  "middle.zz",     "middle.xy",
                                      "middle.yz", "middle.xz", "equivalent", "peak",          "travel",
                                      "work",      "state",     "slip.t",     "support.x",     "support.y",
                                      "ground.x",  "ground.y",  "ground.mz",  "ground.normal", "ground.shear",
                                      "held.x",    "held.y",    "rest.x",     "rest.y"}));
}

TEST_F(ProbesOfABlock, AgreeWithTheTablesOfTheRun) {
  const auto table = read_csv(folder_ / "probes.csv");
  const auto energy = read_csv(folder_ / "energy.csv");
  const auto resultants = read_csv(folder_ / "resultants_foot.csv");
  const auto last = [](const Table& of, const char* column) {
    return of.rows.back()[static_cast<std::size_t>(of.column(column))];
  };
  EXPECT_GT(last(energy, "friction"), 0);
  EXPECT_NEAR(last(table, "work"), last(energy, "friction"), 1e-12 * last(energy, "friction"));
  const double largest = last(resultants, "largest_pressure");
  EXPECT_NEAR(last(table, "peak"), largest, 1e-12 * largest);
  EXPECT_GT(last(table, "travel"), 0.9e-4);
  EXPECT_EQ(last(table, "state"), 2) << "it slips";
}

TEST_F(ProbesOfABlock, AreCheckedAsAllElse) {
  ASSERT_EQ(result_.checks.size(), 10U);
  for (const auto& check : result_.checks)
    EXPECT_TRUE(check.holds) << check.quantity << ' ' << check.value.value_or(NAN);
}

} // namespace
} // namespace rubato::results::probe_values_test
