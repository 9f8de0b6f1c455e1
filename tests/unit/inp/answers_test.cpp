// SPDX-License-Identifier: LGPL-3.0-or-later
// Files whose answers are known in closed form.
#include "rubato/modes/modal_study.hpp"
#include "rubato/modes/modes.hpp"

#include <gtest/gtest.h>

#include "computed.hpp"
#include "support/model_of.hpp"
#include <cmath>
#include <numbers>

namespace rubato::answers_test {
namespace {

using test::computed;

struct Expected {
  const char* file;
  std::size_t run;
  Eigen::Vector3d place;
  int axis;
  double value;
  double tolerance; ///< relative
};

constexpr double exact = 1e-10;
/// σ/E of the bars in tension, and Poisson's part of it.
constexpr double strain = 1e-5;
constexpr double narrowing = -0.3e-5;

void expect_all(const std::vector<Expected>& rows) {
  for (const auto& row : rows)
    EXPECT_NEAR(computed(row.file).displacement(row.run, row.place, row.axis), row.value,
                row.tolerance * std::abs(row.value))
        << row.file;
}

TEST(ElementsOfFiles, PassTheTensionTest) {
  std::vector<Expected> rows;
  for (const auto* file : {"c3d4", "c3d10", "c3d5", "c3d6", "c3d15"}) {
    rows.push_back({file, 0, {1, 1, 1}, 2, strain, exact});
    rows.push_back({file, 0, {1, 1, 1}, 0, narrowing, exact});
    rows.push_back({file, 0, {1, 1, 0}, 1, narrowing, exact});
  }
  for (const auto* file : {"c3d8", "c3d8r", "c3d20", "c3d20r", "c3d27", "syntax"}) {
    rows.push_back({file, 0, {1, 1, 2}, 2, 2 * strain, exact});
    rows.push_back({file, 0, {1, 1, 1}, 2, strain, exact});
    rows.push_back({file, 0, {1, 1, 2}, 0, narrowing, exact});
  }
  for (const auto* file : {"c3d10", "c3d15", "c3d20", "c3d27"})
    rows.push_back({file, 0, {1, 0.5, 0}, 1, narrowing / 2, exact}); // a node between corners
  rows.push_back({"c3d27", 0, {0.5, 0.5, 0.5}, 2, strain / 2, exact});
  rows.push_back({"c3d27", 0, {0.5, 1, 1.5}, 2, 1.5 * strain, exact});
  expect_all(rows);
}

TEST(ElementsOfFiles, PassTheTensionTestInThePlane) {
  std::vector<Expected> rows;
  for (const auto* file : {"cps3", "cps4", "cps6", "cps8r", "cax4"}) {
    rows.push_back({file, 0, {1, 2, 0}, 1, 2 * strain, exact});
    rows.push_back({file, 0, {1, 2, 0}, 0, narrowing, exact});
  }
  for (const auto* file : {"cpe4", "cpe6"}) {
    rows.push_back({file, 0, {1, 2, 0}, 1, 2 * strain * (1 - 0.3 * 0.3), exact});
    rows.push_back({file, 0, {1, 2, 0}, 0, -0.3 * 1.3 * strain, exact});
  }
  rows.push_back({"cax8", 0, {2, 2, 0}, 1, 2 * strain, exact});
  rows.push_back({"cax8", 0, {2, 2, 0}, 0, 2 * narrowing, exact});
  expect_all(rows);
}

TEST(LoadsOfFiles, MoveBarsByTheirClosedForms) {
  constexpr double young = 2e11, density = 7800;
  expect_all({{"gravity", 0, {1, 0, 0}, 0, density * 20 / (2 * young), exact},
              {"centrifugal", 0, {1, 0, 0}, 0, density * 1e4 / (3 * young), exact},
              {"bodyforce", 0, {1, 0, 0}, 0, 1e6 / (2 * young) + 3e6 / young, exact},
              {"expansion", 0, {1, 1, 1}, 0, 1.2e-5 * 100, exact},
              {"expansion", 0, {1, 1, 1}, 1, 1.2e-5 * 100, exact},
              {"orientation", 0, {1, 1, 1}, 0, 1e6 / 10e9, exact},
              {"instances", 0, {2, 0, 0}, 0, 2 * 4e6 / young, 1e-9}});
}

TEST(ContactOfFiles, ClosesAsItsLawsSay) {
  constexpr double young = 2e11, pressure = 1e6, both = 2 * pressure / young;
  const Eigen::Vector3d roof(1, 2, 0);
  // Gaps are measured between the deformed bodies, whose strains are 5e-6.
  expect_all({{"contact_linear", 0, roof, 1, -both - pressure / 1e12, 1e-6},
              {"contact_exponential", 0, roof, 1, -both, 1e-8},
              {"general_contact", 0, roof, 1, -both, 1e-8},
              {"tie", 0, roof, 1, both, 1e-8},
              {"no_separation", 0, roof, 1, -both, 1e-8},
              {"no_separation", 1, roof, 1, both, 1e-8},
              {"contact_hard", 0, {1, 1.01, 0}, 1, -0.015, 1e-8}});
}

TEST(LoadsOfFiles, GoOnFromStepToStep) {
  constexpr double young = 2e11;
  expect_all({{"two_steps", 0, {1, 0, 0}, 0, 1e6 / young, exact},
              {"two_steps", 1, {1, 0, 0}, 0, 3e6 / young, exact},
              {"moved_support", 0, {1, 0, 0}, 0, 1e-3, exact},
              {"moved_support", 1, {0.5, 0, 0}, 0, 1.5e-3, exact}});
  EXPECT_NEAR(computed("two_steps").displacement(2, {1, 0, 0}, 0), 0, 1e-18);
}

/// Mean of the displacements at the end of the bar.
double at_end(const test::Computed& runs, std::size_t run) {
  double sum = 0;
  for (const double y : {0.0, 1.0})
    for (const double z : {0.0, 1.0})
      sum += runs.displacement(run, {1, y, z}, 0);
  return sum / 4;
}

TEST(AmplitudesOfFiles, AreOfTheStepOrOfAllSteps) {
  const auto runs = computed("amplitudes");
  constexpr double young = 2e11;
  // TRIANGLE and SAMPLES have come back to 0, LONG is at 2, SMOOTH at 1.
  EXPECT_NEAR(at_end(runs, 0), 3e6 / young, 1e-14);
  // TRIANGLE, SAMPLES and SMOOTH stay as they ended, LONG goes on to 4.
  EXPECT_NEAR(at_end(runs, 1), 5e6 / young, 1e-14);
}

TEST(ModesOfFiles, AreThoseOfABarOfFourElements) {
  const auto input = inp::read_input(test::inp_file("modes"), inp::Purpose::modes);
  ASSERT_EQ(input.runs.size(), 1U);
  EXPECT_EQ(input.modes.at("run").number, 3);
  EXPECT_EQ(inp::read_input(test::inp_file("modes")).modes, input.modes); // among all steps
  const test::BuiltModel model(modes::modal_study(input.runs[0]));
  const auto modes = modes::modes_of(model, {1, modes::Contact::open});
  const double angle = std::numbers::pi / 8, length = 0.25;
  const double square = 6 * 2e11 / (7800 * length * length) * (1 - std::cos(angle)) / (2 + std::cos(angle));
  EXPECT_NEAR(modes.frequencies[0], std::sqrt(square) / (2 * std::numbers::pi), 1e-8);
}

} // namespace
} // namespace rubato::answers_test
