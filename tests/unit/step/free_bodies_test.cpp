// SPDX-License-Identifier: LGPL-3.0-or-later
/// Static runs of bodies that nothing but contact and friction holds.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/run/failure.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/rings.hpp"
#include "support/two_blocks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace rubato::step::free_bodies_test {
namespace {

using test::Walk;

/// A block on a wider one, pressed on its roof and pushed on its side.
const std::string plane_block = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0.3, 0], to: [0.7, 0.3]}, divisions: [8, 6],
       sides: {bottom: under, top: roof, left: side}}
    - {name: ground, rectangle: {from: [0, -0.2], to: [1, 0]}, divisions: [20, 4], sides: {top: above, bottom: base}}
physics: plane_strain
materials: {steel: {young: 2e11, poisson: 0.3}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: base, fix: [x, y]}]
loads: [{pressure: {on: roof, value: 1e6}}, {pressure: {on: side, value: 2e5, function: ramp}}]
contact: {rest: {master: above, slave: under, integration: nodes, friction: 0.4}}
time: {scheme: static, step: 1, end: 1}
)";

const std::string solid_block = R"(
mesh:
  generate:
    - {name: block, box: {from: [0.3, 0, 0.3], to: [0.7, 0.3, 0.7]}, divisions: [3, 2, 3],
       sides: {bottom: under, top: roof, left: side}}
    - {name: ground, box: {from: [0, -0.2, 0], to: [1, 0, 1]}, divisions: [7, 1, 7], sides: {top: above, bottom: base}}
physics: solid
materials: {steel: {young: 2e11, poisson: 0.3}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: base, fix: [x, y, z]}]
loads: [{pressure: {on: roof, value: 1e6}}, {pressure: {on: side, value: 2e5, function: ramp}}]
contact: {rest: {master: above, slave: under, integration: nodes, friction: 0.4}}
time: {scheme: static, step: 1, end: 1}
)";

int most_iterations(const Walk& walk) {
  int most = 0;
  for (const auto& report : walk.reports)
    most = std::max(most, report.iterations);
  return most;
}

/// Contact carries the whole load, and the block stays where it is but for its strain.
void expect_held(const Walk& walk, const Eigen::Vector3d& load, double stays_within) {
  const auto carried = walk.resultants();
  const Eigen::Vector3d force = carried.force;
  EXPECT_LE((force + load).norm(), 1e-7 * load.norm()) << force.transpose();
  EXPECT_LE(walk.state().motion.u.lpNorm<Eigen::Infinity>(), stays_within);
}

struct Block {
  const char* name;
  bool solid;
  const char* cells;
};

class BlockOf : public testing::TestWithParam<Block> {
protected:
  static std::string deck() { return GetParam().solid ? solid_block : plane_block; }
  static std::vector<deck::Setting> changes() {
    return {{"mesh.generate.0.cells", GetParam().cells}, {"mesh.generate.1.cells", GetParam().cells}};
  }
  static Eigen::Vector3d load(double push) {
    const double depth = GetParam().solid ? 0.4 : 1;
    return {push * 0.3 * depth, -1e6 * 0.4 * depth, 0};
  }
};

TEST_P(BlockOf, IsHeldByFrictionAlone) {
  // Points of TRIA6 faces share multipliers: pushed, they take many attempts yet.
  const bool shares = std::string_view(GetParam().cells) == "tetra10";
  for (const double push : shares ? std::vector{0.0} : std::vector{0.0, 2e5, 3e5}) {
    auto settings = changes();
    settings.push_back({"loads.1.pressure.value", std::to_string(push)});
    Walk walk(deck(), settings);
    ASSERT_TRUE(walk.to_end()) << push;
    EXPECT_EQ(walk.reports.size(), 1U) << "the step was cut";
    EXPECT_LE(most_iterations(walk), 40) << push;
    expect_held(walk, load(push), 1e-5);
  }
}

TEST_P(BlockOf, IsHeldInManySteps) {
  auto settings = changes();
  settings.push_back({"time.step", "0.2"});
  Walk walk(deck(), settings);
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 5U) << "a step was cut";
  expect_held(walk, load(2e5), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Any, BlockOf,
                         testing::Values(Block{"Quad4", false, "quad4"}, Block{"Quad8", false, "quad8"},
                                         Block{"Tria6", false, "tria6"}, Block{"Hexa8", true, "hexa8"},
                                         Block{"Tetra4", true, "tetra4"}, Block{"Tetra10", true, "tetra10"},
                                         Block{"Hexa20", true, "hexa20"}, Block{"Hexa27", true, "hexa27"}),
                         [](const auto& block) { return block.param.name; });

/// Pressed in the first step, dragged in the second. Points that close while they slide have no friction yet.
TEST(FreeBlock, BeginsToSlipInFewIterations) {
  const std::vector<deck::Setting> in_plane{{"mesh.generate.0.divisions", "[12, 6]"},
                                            {"mesh.generate.1.divisions", "[17, 5]"}};
  for (const auto& [deck, fixed, settings] :
       {std::tuple{plane_block, "[x, y]", in_plane},
        std::tuple{solid_block, "[x, y, z]", std::vector<deck::Setting>{}}})
    for (const auto& [friction, drag] :
         {std::pair{"0.3", "1e-5"}, std::pair{"0.3", "1e-4"}, std::pair{"0.3", "4e-3"},
          std::pair{"1", "4e-3"}, std::pair{"1", "1e-2"},
          std::pair{"2", "4e-3"}}) { // beyond 0.7 or 1 the blocks tilt before they slip
      auto changes = settings;
      changes.push_back({"functions", "{push: {times: [0, 1, 2], values: [0, 0, 1]}}"});
      changes.push_back({"supports", "[{on: base, fix: " + std::string(fixed) + "}, {on: roof, x: {value: " +
                                         std::string(drag) + ", function: push}}]"});
      changes.push_back({"loads", "[{pressure: {on: roof, value: 1e7}}]"});
      changes.push_back({"contact.rest.friction", friction});
      changes.push_back({"time.end", "2"});
      Walk walk(deck, changes);
      ASSERT_TRUE(walk.to_end()) << friction << " " << drag;
      EXPECT_EQ(walk.reports.size(), 2U) << "a step was cut";
      EXPECT_LE(walk.reports.back().iterations, 15) << friction << " " << drag;
    }
}

TEST(FreeBlock, BeyondFrictionAndBalanceIsToldWithItsBody) {
  Walk walk(plane_block, {{"loads.1.pressure.value", "5.5e5"},
                          {"newton.max_iterations", "10"},
                          {"time.on_failure.levels", "1"}});
  EXPECT_FALSE(walk.advance());
  results::Failure failure;
  failure.end = 1;
  failure.report = walk.reports.back();
  const auto text = run::explain(walk.model, failure);
  EXPECT_NE(
      text.find(
          "nothing but contact holds the body of node N1 (0.3, 0) along x, along y, against turning about z"),
      std::string::npos)
      << text;
}

TEST(FreeBlock, ThatMayOnlyTurnIsToldSo) {
  const Walk walk(test::with(plane_block, "left: side}", "left: side}, points: {left_bottom: pivot}"),
                  {{"supports", "[{on: base, fix: [x, y]}, {on: pivot, fix: [x, y]}]"}});
  ASSERT_FALSE(walk.model.free_body_nodes.empty());
  const auto text = run::explain(walk.model, results::Failure());
  EXPECT_NE(text.find("nothing but contact holds the body of node N1 (0.3, 0) against turning about z"),
            std::string::npos)
      << text;
}

/// The weak springs are part of the whole system too, and their forces are gone in the end.
TEST(FreeBlock, IsTheSameByTheWholeSystem) {
  const std::vector<deck::Setting> smooth{{"contact.rest.friction", "0"},
                                          {"supports", "[{on: base, fix: [x, y]}, {on: side, fix: x}]"},
                                          {"loads", "[{pressure: {on: roof, value: 1e6}}]"}};
  auto by_whole = smooth;
  by_whole.push_back({"solver", "full"});
  Walk condensed(plane_block, smooth);
  Walk whole(plane_block, by_whole);
  ASSERT_TRUE(condensed.to_end());
  ASSERT_TRUE(whole.to_end());
  // Gaps count as closed at 1e-9 of an edge.
  const double allowed = 1e-9 * condensed.model.zones.front().edge();
  EXPECT_LE((condensed.state().motion.u - whole.state().motion.u).lpNorm<Eigen::Infinity>(), allowed);
}

constexpr double gap = 0.05;

/// Wraps rectangles over [0, π] round the origin: x is the angle, y the radius.
mesh::Mesh wrapped(mesh::Mesh mesh) {
  for (auto& point : mesh.points)
    point = Eigen::Vector3d(-point.y() * std::cos(point.x()), point.y() * std::sin(point.x()), 0.0);
  return mesh;
}

/// A saddle, a half ring, above a pin that is held at its core.
std::string saddle_deck(int cells) {
  return "mesh:\n"
         "  generate:\n"
         "    - {name: pin, rectangle: {from: [0, 0.3], to: [3.141592653589793, " +
         std::to_string(1 - gap) +
         "]}, divisions: [24, 4], sides: {bottom: core, top: pin_skin}}\n"
         "    - {name: saddle, rectangle: {from: [0, 1], to: [3.141592653589793, 1.3]}, divisions: [" +
         std::to_string(cells) +
         ", 3], sides: {bottom: saddle_skin}}\n"
         "physics: plane_strain\n"
         "materials: {steel: {young: 2e11, poisson: 0.3, density: 7800}}\n"
         "supports: [{on: core, fix: [x, y]}]\n"
         "loads: [{gravity: {on: saddle, y: -10}}]\n"
         "contact: {rest: {master: pin_skin, slave: saddle_skin, integration: nodes, friction: 0.3}}\n"
         "time: {scheme: static, step: 1, end: 1}\n";
}

TEST(FreeSaddle, DropsOnAPin) {
  for (const int cells : {24, 30}) {
    const auto study = deck::parse_deck(saddle_deck(cells), "deck.yaml", {}).runs.front();
    Walk walk(study, wrapped(model::load_mesh(study.mesh)));
    ASSERT_TRUE(walk.to_end()) << cells;
    EXPECT_EQ(walk.reports.size(), 1U) << "the step was cut";
    EXPECT_LE(most_iterations(walk), 20) << cells;
    const auto carried = walk.resultants();
    // The chords of the rings enclose less than the rings do.
    const double turn = std::numbers::pi / cells;
    const double weight = 7800 * 10 * cells / 2.0 * std::sin(turn) * (1.3 * 1.3 - 1);
    const Eigen::Vector3d force = carried.force;
    EXPECT_NEAR(force.y(), weight, 1e-6 * weight) << cells;
    EXPECT_NEAR(force.x(), 0, 1e-6 * weight) << cells;
    EXPECT_NEAR(walk.displacement(walk.node_at(0, 1), 1), -gap, 0.2 * gap) << cells;
  }
}

/// A whole ring on a round pin: friction alone holds it.
std::string ring_deck(int cells, double load) {
  return "mesh:\n"
         "  generate:\n"
         "    - {name: pin, rectangle: {from: [0, 0.3], to: [6.283185307179586, 0.9]}, divisions: [40, 6],"
         " sides: {bottom: core, top: pin_skin}}\n"
         "    - {name: ring, rectangle: {from: [0, 1], to: [6.283185307179586, 1.3]}, divisions: [" +
         std::to_string(cells) +
         ", 4], sides: {bottom: ring_skin}}\n"
         "physics: plane_strain\n"
         "materials: {steel: {young: 2e11, poisson: 0.3, density: 1}}\n"
         "supports: [{on: core, fix: [x, y]}]\n"
         "loads: [{gravity: {on: ring, y: " +
         std::to_string(-load) +
         "}}]\n"
         "contact: {rest: {master: pin_skin, slave: ring_skin, integration: nodes, friction: 0.3}}\n"
         "time: {scheme: static, step: 1, end: 1}\n";
}

/// Facets alone resist its turn. Moves that go one way are not taken further: it would roll over them.
TEST(FreeRing, HangsOnAPinWithoutFriction) {
  const std::vector<deck::Setting> smooth{{"contact.rest.friction", "0"}};
  for (const double load : {7.8e4, 1e6, 1e8}) {
    const auto study = deck::parse_deck(ring_deck(96, load), "deck.yaml", smooth).runs.front();
    Walk walk(study, test::closed_rings(model::load_mesh(study.mesh)));
    ASSERT_TRUE(walk.to_end()) << load;
    EXPECT_EQ(walk.reports.size(), 1U) << "the step was cut";
    EXPECT_LE(most_iterations(walk), 10) << load;
  }
}

/// Its turn is held, as nothing but facets resists it: nodes come to rest in valleys between facets.
TEST(FreeRing, DropsOnAPinWithoutFriction) {
  const std::vector<deck::Setting> smooth{{"contact.rest.friction", "0"}};
  for (const int cells : {47, 48, 52, 58, 96})
    for (const double drop : {0.1, 0.01})
      for (const double load : {7.8e4, 1e6}) {
        auto changes = smooth;
        changes.push_back(
            {"mesh.generate.0.rectangle.to", "[6.283185307179586, " + std::to_string(1 - drop) + "]"});
        const auto study = deck::parse_deck(ring_deck(cells, load), "deck.yaml", changes).runs.front();
        Walk walk(study, test::closed_rings(model::load_mesh(study.mesh)));
        EXPECT_EQ(walk.model.notes.size(), 1U);
        ASSERT_TRUE(walk.to_end()) << cells << " " << drop << " " << load;
        EXPECT_EQ(walk.reports.size(), 1U) << "the step was cut";
        EXPECT_LE(most_iterations(walk), 10) << cells << " " << drop << " " << load;
        const double weight = load * cells / 2.0 * std::sin(2 * std::numbers::pi / cells) * (1.3 * 1.3 - 1);
        const Eigen::Vector3d force = walk.resultants().force;
        EXPECT_NEAR(force.y(), weight, 1e-6 * weight) << cells;
        EXPECT_NEAR(force.x(), 0, 1e-6 * weight) << cells;
        EXPECT_NEAR(walk.displacement(walk.node_at(1, 0), 1), -drop, 0.2 * drop + 2e-3) << cells;
      }
}

/// What presses at one point of the ring puts on it depends on what rubs at another.
TEST(FreeRing, IsHeldByFrictionOnAPin) {
  for (const int cells : {43, 47, 55})
    for (const double load : {7.8e4, 1e6, 1e8}) {
      const auto study = deck::parse_deck(ring_deck(cells, load), "deck.yaml", {}).runs.front();
      Walk walk(study, test::closed_rings(model::load_mesh(study.mesh)));
      ASSERT_TRUE(walk.to_end()) << cells << " " << load;
      EXPECT_EQ(walk.reports.size(), 1U) << "the step was cut";
      EXPECT_LE(most_iterations(walk), 25) << cells << " " << load;
      const double weight = load * cells / 2.0 * std::sin(2 * std::numbers::pi / cells) * (1.3 * 1.3 - 1);
      const Eigen::Vector3d force = walk.resultants().force;
      EXPECT_NEAR(force.y(), weight, 1e-6 * weight) << cells;
      EXPECT_NEAR(force.x(), 0, 1e-6 * weight) << cells;
    }
}

/// In ten steps to one and the same place: K u of a body far off its place has the rounding of |K||u| in it,
/// whose resultant is not to work on the whole way there.
TEST(FreeRing, HasALedgerThatClosesInManySteps) {
  for (const int cells : {47, 48})
    for (const char* friction : {"0", "0.3"}) {
      const std::vector<deck::Setting> changes{{"contact.rest.friction", friction},
                                               {"mesh.generate.0.rectangle.to", "[6.283185307179586, 0.9]"},
                                               {"time.step", "0.1"}};
      const auto study = deck::parse_deck(ring_deck(cells, 7.8e4), "deck.yaml", changes).runs.front();
      Walk walk(study, test::closed_rings(model::load_mesh(study.mesh)));
      EnergyRecord record;
      while (!walk.finished()) {
        ASSERT_TRUE(walk.advance()) << cells << " " << friction;
        record.note(walk.state().t, walk.simulation.energy());
      }
      EXPECT_GT(record.largest, 1e4);
      EXPECT_LE(record.largest_balance, 1e-11 * record.largest) << cells << " " << friction;
      EXPECT_LE(std::abs(walk.simulation.energy().unbalanced), 1e-8 * record.largest)
          << cells << " " << friction;
    }
}

/// Weak springs carry loads over edges, springs of penalties by a trace of one.
TEST(FreeBlock, RestsOnPenaltiesToTheLastDigits) {
  Walk walk(plane_block, {{"contact.rest.method", "penalty"}, {"newton.residual", "1e-11"}});
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 1U) << "the step was cut";
  EXPECT_LE(most_iterations(walk), 12);
}

} // namespace
} // namespace rubato::step::free_bodies_test
