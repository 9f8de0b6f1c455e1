// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies that come from afar in one step are found, and one that came too deep is told.
#include "rubato/deck/read.hpp"
#include "rubato/run/overlap_watch.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::run::overlap_watch_test {
namespace {

using test::Walk;

/// A block of side 1 whose bottom is 0.5 above a floor, both of faces shorter than that.
const std::string far_apart = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0.3, 0.5], to: [1.3, 1]}, divisions: [10, 5], cells: quad4, sides: {bottom: under, top: roof}}
    - {name: floor, rectangle: {from: [0, -0.5], to: [2, 0]}, divisions: [13, 3], cells: quad4, sides: {top: over, bottom: ground}}
physics: plane_strain
materials: {steel: {young: 1e9, poisson: 0.3, density: 1000}}
supports: [{on: ground, fix: [x, y]}, {on: roof, x: 0}]
springs: [{on: block, y: 1e3}]
loads: [{surface_force: {on: roof, y: -1e6}}]
contact: {rest: {master: over, slave: under}}
time: {scheme: static, step: 1, end: 1}
)";

const deck::Setting plane{"contact.rest.obstacle", "{plane: {point: [0, 0], normal: [0, 1]}}"};
const deck::Setting no_master{"contact.rest.master", "~"};
const std::vector<std::vector<deck::Setting>> floors{
    {},
    {{"contact.rest.integration", "nodes"}},
    {no_master, plane, {"contact.rest.integration", "mortar"}},
    {no_master, plane}};

class Overlap : public testing::Test {
protected:
  Overlap() {
    watch_.warn = [this](const std::string& text) { warned_.push_back(text); };
  }

  void walk(const std::vector<deck::Setting>& changes) { run(far_apart, changes); }

  void run(const std::string& deck, const std::vector<deck::Setting>& changes) {
    warned_.clear();
    Walk walk(deck, changes);
    OverlapWatch overlaps(walk.model, watch_);
    walk.accepted = [&] { overlaps.note(walk.before, walk.state()); };
    ASSERT_TRUE(walk.to_end());
    force_ = walk.resultants().force.y();
    smallest_gap_ = walk.resultants().smallest_gap;
  }

  Watch watch_;
  std::vector<std::string> warned_;
  double force_ = 0, smallest_gap_ = 0;
};

TEST_F(Overlap, IsNoneWhereALoadPushesABodyOntoAFloorFarBelowIt) {
  for (const auto& floor : floors) {
    walk(floor);
    EXPECT_NEAR(force_, 1e6, 0.04e6) << "springs have the rest";
    EXPECT_GT(smallest_gap_, -1e-9);
    EXPECT_TRUE(warned_.empty()) << warned_.front();
  }
}

/// Half a second of free fall: with mass on the slave moreau_jean sees the floor half a step late. Without it
/// an open point reaches no farther than the floor.
TEST_F(Overlap, IsToldOnceWhenAStepIsTooLong) {
  for (auto fall : floors) {
    fall.insert(fall.end(),
                {{"springs", "~"},
                 {"loads", "[{gravity: {y: -9.81}}]"},
                 {"time", "{scheme: moreau_jean, contact_mass: consistent, step: 0.5, end: 2.5}"}});
    walk(fall);
    EXPECT_NEAR(force_, 4905, 5) << "its weight: it rests";
    ASSERT_EQ(warned_.size(), 1U);
    EXPECT_NE(
        warned_.front().find("in the step from t = 0 to 0.5 the surfaces of contact.rest came to overlap by "
                             "0.726 at node"),
        std::string::npos)
        << warned_.front();
    EXPECT_NE(warned_.front().find("more than its faces are long (0.1); results may be wrong from there on, "
                                   "expected shorter steps"),
              std::string::npos)
        << warned_.front();
  }
}

/// A spring that gives way by more than a face is told too, with what helps.
TEST_F(Overlap, OfASoftSpringNamesItsCoefficient) {
  walk({{"contact.rest.method", "penalty"}, {"contact.rest.coefficients", "{normal: 1e6}"}});
  ASSERT_EQ(warned_.size(), 1U);
  EXPECT_NE(warned_.front().find("expected shorter steps or a larger coefficients.normal"), std::string::npos)
      << warned_.front();
}

/// A punch that is narrower than a face of the floor, which is the slave, and comes down between its nodes.
const std::string narrow_punch = R"(
mesh:
  generate:
    - {name: punch, rectangle: {from: [0.49, 0], to: [0.51, 0.1]}, divisions: [2, 5], cells: quad4, sides: {bottom: tip, top: roof}}
    - {name: floor, rectangle: {from: [0, -0.5], to: [1, 0]}, divisions: [5, 3], cells: quad4, sides: {top: over, bottom: ground}}
physics: plane_strain
materials: {steel: {young: 1e9, poisson: 0.3, density: 1000}}
supports: [{on: ground, fix: [x, y]}, {on: roof, x: 0, y: {value: -0.012, function: ramp}}]
functions: {ramp: {times: [0, 1], values: [0, 1]}}
contact: {rest: {master: tip, slave: over}}
time: {scheme: static, step: 0.25, end: 1}
)";

TEST_F(Overlap, OfAMasterThatNodesOfTheSlaveDoNotFeelIsTold) {
  run(narrow_punch, {{"contact.rest.integration", "nodes"}});
  EXPECT_EQ(force_, 0);
  ASSERT_EQ(warned_.size(), 1U);
  EXPECT_NE(warned_.front().find("at t = 0.5 node "), std::string::npos) << warned_.front();
  EXPECT_NE(
      warned_.front().find("of the master of contact.rest lies 0.006 behind the slave, whose faces (up to "
                           "0.2 long) do not feel it; results may be wrong from there on, expected the "
                           "finer surface as slave, or smaller faces"),
      std::string::npos)
      << warned_.front();
}

TEST_F(Overlap, IsSmallOnTheRightSideAndByMortarOnEither) {
  run(narrow_punch, {{"contact.rest", "{master: over, slave: tip}"}});
  const double right = force_;
  EXPECT_GT(right, 1e5);
  EXPECT_TRUE(warned_.empty()) << warned_.front();
  run(narrow_punch, {});
  EXPECT_NEAR(-force_, right, 0.5 * right);
}

} // namespace
} // namespace rubato::run::overlap_watch_test
