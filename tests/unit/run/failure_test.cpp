// SPDX-License-Identifier: LGPL-3.0-or-later
// What is said of a step that could not be made, and that nothing is advised which the deck would refuse.
#include "rubato/deck/read.hpp"
#include "rubato/run/advice.hpp"
#include "rubato/run/failure.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <set>

namespace rubato::run::failure_test {
namespace {

using step::Criterion;
using step::Outcome;
using step::Unmet;

class FailureOf {
public:
  explicit FailureOf(const std::string& deck)
      : model_(test::BuiltModel(deck::parse_deck(deck, "deck.yaml").runs.front())) {}

  /// A step that ended so, at the whole of its length.
  results::Failure with(Outcome outcome, std::vector<Unmet> unmet) const {
    results::Failure failure;
    failure.end = 1e-4;
    failure.report.outcome = outcome;
    failure.report.residual = 7e-16;
    failure.report.tolerance = 1e-8;
    failure.report.worst_node = 0;
    failure.report.unmet = std::move(unmet);
    return failure;
  }

  std::vector<std::string> advice_for(const results::Failure& failure) const {
    return advice(model_, time::make_scheme(model_.study.time), failure);
  }
  std::string told(const results::Failure& failure) const { return explain(model_, failure); }
  const study::Study& study() const { return model_.study; }

private:
  test::BuiltModel model_;
};

bool has(const std::vector<std::string>& lines, const std::string& part) {
  return std::ranges::any_of(lines, [&](const auto& line) { return line.find(part) != std::string::npos; });
}

/// Those advices that are a key of the deck and its value.
std::vector<deck::Setting> settings_in(const std::vector<std::string>& lines) {
  std::vector<deck::Setting> settings;
  for (const auto& line : lines) {
    const auto text = line.substr(0, line.find(", wh"));
    if (const auto colon = text.find(": "); colon != std::string::npos && text.find(' ') > colon)
      settings.push_back({text.substr(0, colon), text.substr(colon + 2)});
  }
  return settings;
}

const std::string steady = "time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}";
const std::string friction = "friction: 0.2, ";

std::string with_method(const std::string& method, const std::string& scheme = steady) {
  auto deck = test::with(test::two_blocks, friction, "method: " + method + ", ");
  return scheme == steady ? deck : test::with(deck, steady, scheme);
}

TEST(AFailedStep, NamesTheGapThatIsNotClosed) {
  const FailureOf blocks(test::two_blocks);
  const auto text =
      blocks.told(blocks.with(Outcome::too_many_iterations, {{Criterion::gap, 0, 3, 3.1e-6, 2.5e-10, 4}}));
  EXPECT_NE(text.find("the gap of zone 'interface' is not closed: 3.10e-06 at node N4 ("), std::string::npos)
      << text;
  EXPECT_NE(text.find("(allowed 2.5e-10), and at 3 more points"), std::string::npos) << text;
  EXPECT_EQ(text.find("residual"), std::string::npos) << "forces are in balance\n" << text;
}

TEST(AFailedStep, NamesTheProjectionThatMovesAndThePointThatIsLost) {
  const FailureOf blocks(test::two_blocks);
  const auto text =
      blocks.told(blocks.with(Outcome::too_many_iterations, {{Criterion::point_lost, 0, 3, 1, 0, 1},
                                                             {Criterion::projection, 0, 4, 0.2, 1e-6, 1}}));
  EXPECT_NE(text.find("contact was lost at node N4 ("), std::string::npos) << text;
  EXPECT_NE(text.find("touched before, it faces nothing now"), std::string::npos) << text;
  EXPECT_NE(
      text.find("the projection on the master of zone 'interface' still moves: by 2.00e-01 of a face at "
                "node N5 ("),
      std::string::npos)
      << text;
}

TEST(AFailedStep, NamesTheNodeThatIsPressedWhereNothingIs) {
  const FailureOf blocks(test::two_blocks);
  const auto failure = blocks.with(Outcome::pressed_afar, {{Criterion::distance, 0, 3, 1.9, 1.2, 1}});
  const auto text = blocks.told(failure);
  EXPECT_NE(text.find("(pressed where nothing is, 0 iterations); zone 'interface' presses node N4 ("),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("which is 1.9 from its master (allowed 1.2)"), std::string::npos) << text;
}

TEST(AFailedStep, NamesTheBodiesThatNothingHoldsWhereTheMatrixIsSingular) {
  auto deck = test::with(test::two_blocks, "sides: {left: held, bottom: upper_face, top: roof}",
                         "sides: {left: upper_left, bottom: upper_face, top: roof}");
  deck = test::with(deck, "  - {on: held, fix: [x, y]}\n",
                    "  - {on: held, fix: [x, y]}\n  - {on: upper_left, fix: x}\n");
  const FailureOf blocks(deck);
  auto failure = blocks.with(Outcome::singular_matrix, {{Criterion::singular}});
  failure.advice = blocks.advice_for(failure);
  const auto text = blocks.told(failure);
  EXPECT_NE(text.find("(singular matrix, 0 iterations); nothing but contact holds the body of node N1 (0, 0) "
                      "along y; what may help: supports or springs along y for the body of node N1 (0, 0)"),
            std::string::npos)
      << text;
}

TEST(Advice, AgainstTheRollOfSectionsIsFriction) {
  const std::string ring = R"deck(
mesh: {generate: [{name: ring, rectangle: {from: [9, 0], to: [10, 1]}, divisions: [1, 1],
  sides: {bottom: under, top: above}}]}
physics: axisymmetric
materials: {rubber: {young: 5, poisson: 0.4}}
contact:
  floor: {slave: under, obstacle: {plane: {point: [0, 0], normal: [0, 1]}}}
  lid: {slave: above, obstacle: {plane: {point: [0, 1], normal: [0, -1]}, move: {y: {value: -0.1, function: f}}}}
functions: {f: {ramp: {begin: 0, end: 1}}}
time: {scheme: static, step: 0.1, end: 1}
)deck";
  const std::string rolling =
      "friction, or supports that keep the section from rolling, for the body of node N1 (9, 0)";
  const auto advice_for = [](const std::string& deck) {
    const FailureOf failed(deck);
    return failed.advice_for(failed.with(Outcome::too_many_iterations, {}));
  };
  EXPECT_TRUE(has(advice_for(ring), rolling));
  EXPECT_FALSE(has(advice_for(test::with(ring, "slave: under,", "slave: under, friction: 0.1,")), rolling));
}

/// A path of static states leads nowhere from there, whatever the matrix without contact is.
TEST(Advice, OfABodyThatTipsOrSlidesIsLessLoadOrInertia) {
  const std::string tower = R"deck(
mesh: {generate: [{name: tower, rectangle: {from: [0, 0], to: [1, 3]}, divisions: [2, 6], sides: {bottom: under}}]}
physics: plane_strain
materials: {stone: {young: 3e10, poisson: 0.2, density: 2400, strain: green_lagrange}}
loads: [{gravity: {x: 4, y: -10}}]
contact: {floor: {slave: under, obstacle: {plane: {point: [0, 0], normal: [0, 1]}}, friction: 0.9}}
time: {scheme: static, step: 0.1, end: 1}
)deck";
  const auto advice_for = [](const std::string& deck) {
    const FailureOf failed(deck);
    auto failure = failed.with(Outcome::too_many_iterations, {{Criterion::residual}});
    failure.report.indefinite = true;
    return failed.advice_for(failure);
  };
  const auto lines = advice_for(tower);
  EXPECT_TRUE(has(lines, "less load, if the body tips or slides beyond its friction"));
  EXPECT_TRUE(has(lines, "time.scheme: moreau_jean, which follows how it moves then"));
  EXPECT_TRUE(
      has(lines, "supports or springs along x, along y, against turning about z for the body of node N1"));
  EXPECT_FALSE(has(lines, "arc_length"));
  EXPECT_FALSE(has(lines, "newton.max_iterations"));
  const auto weightless = test::with(test::with(tower, ", density: 2400", ""), "gravity: {x: 4, y: -10}",
                                     "surface_force: {on: under, x: 4}");
  EXPECT_FALSE(has(advice_for(weightless), "time.scheme")) << "it would need a density";
  const auto held = test::with(tower, "loads:", "supports: [{on: under, fix: [x, y]}]\nloads:");
  EXPECT_TRUE(has(advice_for(held), "arc_length"));
}

TEST(Advice, AgainstAGapIsSpringsInItsPlaceAndNotAShorterStepThatWasTriedAlready) {
  const FailureOf blocks(test::two_blocks);
  auto failure = blocks.with(Outcome::too_many_iterations, {{Criterion::gap, 0, 3, 3.1e-6, 2.5e-10, 4}});
  EXPECT_EQ(blocks.advice_for(failure).front(),
            "contact.interface.method: penalty, whose gaps need not close");
  EXPECT_TRUE(has(blocks.advice_for(failure), "a shorter time.step"));
  failure.cut_level = 12;
  EXPECT_FALSE(has(blocks.advice_for(failure), "a shorter time.step"));
}

TEST(Advice, AgainstALostPointIsALargerMaster) {
  const FailureOf blocks(test::two_blocks);
  const auto lines =
      blocks.advice_for(blocks.with(Outcome::cycling, {{Criterion::point_lost, 0, 3, 1, 0, 1}}));
  EXPECT_TRUE(lines.front().starts_with("a master of zone 'interface' that goes on past node N4"))
      << lines[0];
}

/// Nodal methods hold their relations in a loop: `geometry: newton` is refused for them.
TEST(Advice, AgainstAGeometryLoopIsWhatTheMethodAllows) {
  const std::vector<Unmet> unmet{{Criterion::geometry_loop, -1, 3, 0.1, 1e-2, 1}};
  for (const std::string method : {"nodal_lagrange", "nodal_penalty", "nodal_pcg"}) {
    const FailureOf blocks(with_method(method));
    const auto lines = blocks.advice_for(blocks.with(Outcome::geometry_unsettled, unmet));
    EXPECT_FALSE(has(lines, "iterate.geometry: newton")) << method;
    EXPECT_TRUE(has(lines, "contact.interface.iterate.geometry: {by: fixed_point, tolerance: 0.01, "
                           "max_loops: 30}"))
        << method;
  }
  const FailureOf blocks(
      test::with(test::two_blocks, friction, friction + "iterate: {geometry: fixed_point}, "));
  EXPECT_EQ(blocks.advice_for(blocks.with(Outcome::geometry_unsettled, unmet)).front(),
            "contact.interface.iterate.geometry: newton");
}

TEST(Advice, OfListedInstantsIsMoreOfThem) {
  const FailureOf blocks(
      test::with(test::two_blocks, steady, "time: {scheme: hht, alpha: -0.1, instants: [1e-4, 2e-4]}"));
  const auto lines = blocks.advice_for(
      blocks.with(Outcome::too_many_iterations, {{Criterion::residual, -1, 3, 1, 1e-8, 1}}));
  EXPECT_FALSE(has(lines, "time.step"));
  EXPECT_TRUE(has(lines, "more time.instants around 0.0001"));
}

/// Springs have no impulses: moreau_jean is refused beside them.
TEST(Advice, IsMoreauJeanOnlyWhereEveryZoneGoesWithIt) {
  const std::vector<Unmet> unmet{{Criterion::residual, -1, 3, 1, 1e-8, 1}};
  const auto lines = [&](const std::string& method) {
    const FailureOf blocks(with_method(method, "time: {scheme: newmark, step: 1e-4, end: 4e-4}"));
    return blocks.advice_for(blocks.with(Outcome::too_many_iterations, unmet));
  };
  EXPECT_TRUE(has(lines("augmented_lagrangian"), "moreau_jean"));
  EXPECT_TRUE(has(lines("augmented_lagrangian, friction: 0.2"), "moreau_jean"));
  EXPECT_FALSE(has(lines("augmented_lagrangian, friction: 0.2, friction_method: penalty"), "moreau_jean"));
  EXPECT_FALSE(has(lines("nodal_lagrange, friction: 0.2"), "moreau_jean"));
}

class AnyMethod : public testing::TestWithParam<std::string> {};

TEST_P(AnyMethod, IsNeverAdvisedWhatItsDeckRefuses) {
  using enum Criterion;
  for (const auto* scheme : {"time: {scheme: hht, alpha: 0, step: 1e-4, end: 4e-4}",
                             "time: {scheme: newmark, beta: 0.25, step: 1e-4, end: 4e-4}",
                             "time: {scheme: static, instants: [1, 2]}"}) {
    const FailureOf blocks(with_method(GetParam(), scheme));
    std::set<std::string> all;
    for (const auto outcome : {Outcome::too_many_iterations, Outcome::geometry_unsettled})
      for (const auto criterion : {residual, status, gap, projection, geometry_loop, friction_loop}) {
        const auto lines = blocks.advice_for(blocks.with(outcome, {{criterion, 0, 3, 1, 1e-8, 1}}));
        EXPECT_FALSE(lines.empty());
        all.insert(lines.begin(), lines.end());
      }
    const auto settings = settings_in({all.begin(), all.end()});
    EXPECT_GE(settings.size(), 2U);
    for (const auto& setting : settings)
      EXPECT_TRUE(deck::accepts(blocks.study(), std::vector{setting}))
          << setting.path << ": " << setting.value;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, AnyMethod,
                         testing::Values("augmented_lagrangian", "penalty", "nodal_lagrange", "nodal_penalty",
                                         "nodal_pcg", "augmented_lagrangian, friction: 0.1",
                                         "augmented_lagrangian, friction: 0.1, friction_method: penalty",
                                         "nodal_lagrange, friction: 0.1",
                                         "augmented_lagrangian, iterate: {status: fixed_point, friction: "
                                         "fixed_point, geometry: fixed_point}"));

} // namespace
} // namespace rubato::run::failure_test
