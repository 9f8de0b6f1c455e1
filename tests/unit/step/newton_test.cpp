// SPDX-License-Identifier: LGPL-3.0-or-later
/// How Newton converges, and what its answer must not depend on.
#include "rubato/step/full/whole_system.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

using test::Walk;
using Changes = std::vector<deck::Setting>;

/// Deflections of the loaded corner after each step.
std::vector<double> tip_history(const Changes& changes) {
  Walk walk(test::two_beams, changes);
  const auto tip = walk.node_at(1, 0.1);
  std::vector<double> history;
  while (!walk.finished()) {
    if (!walk.advance())
      return {};
    history.push_back(walk.displacement(tip, 1));
  }
  return history;
}

double largest(const std::vector<double>& values) {
  double found = 0;
  for (const double value : values)
    found = std::max(found, std::abs(value));
  return found;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size())
    return std::numeric_limits<double>::infinity();
  double found = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    found = std::max(found, std::abs(a[i] - b[i]));
  return found;
}

/// Relative residuals after 1, 2, … iterations of the first step, each from a run that is stopped there.
std::vector<double> residuals_by_iteration(const Changes& changes) {
  std::vector<double> residuals;
  for (int iterations = 1; iterations < 40; ++iterations) {
    auto all = changes;
    all.push_back({"newton.max_iterations", std::to_string(iterations)});
    Walk walk(test::two_beams, all);
    auto system = make_effective_system(walk.model, walk.scheme, walk.length());
    const double t = walk.target();
    State trial = predict(walk.model, walk.scheme, system, walk.state(), t);
    const ContactEvaluator side(walk.model, walk.scheme, system, walk.state(), {.start = Start::last_step});
    Pulse pulse;
    Newton newton(walk.model, walk.scheme, system, walk.state(), t, side, pulse);
    const auto report = newton.run(trial, Frozen(walk.model.zones.size()));
    residuals.push_back(report.residual);
    if (report.converged())
      break;
  }
  return residuals;
}

/// Once the statuses stand, each residual is far below the square root of the one before.
TEST(NewtonOnASlidingContact, ConvergesQuadratically) {
  const auto residuals =
      residuals_by_iteration({{"contact.interface.friction", "0"}, {"newton.residual", "1e-12"}});
  const auto count = residuals.size();
  ASSERT_GE(count, 3u);
  ASSERT_LT(count, 39u);
  EXPECT_LT(residuals[count - 1], 1e-12);
  EXPECT_LT(residuals[count - 2], std::pow(residuals[count - 3], 2));
}

TEST(Augmentation, DoesNotChangeTheAnswer) {
  const auto reference = tip_history({});
  ASSERT_EQ(reference.size(), 12u);
  Walk walk(test::two_beams);
  const auto system = make_effective_system(walk.model, walk.scheme, 1e-3);
  const double c = system.zones.front().normal[10];
  const double c_t = system.zones.front().tangential[10];
  for (const double factor : {1e-3, 1e-1, 1e1, 1e2})
    for (const bool normal : {true, false}) {
      const double value = factor * (normal ? c : c_t);
      const std::string key = normal ? "normal" : "tangential";
      const auto history =
          tip_history({{"contact.interface.coefficients", "{" + key + ": " + std::to_string(value) + "}"}});
      EXPECT_LT(largest_difference(history, reference), 1e-9 * largest(reference)) << key << " x " << factor;
    }
}

TEST(FirstGuessOfTheContactSet, DoesNotChangeTheAnswer) {
  const auto reference = tip_history({});
  const auto history = tip_history({{"contact.interface.initially_active", "false"}});
  EXPECT_LT(largest_difference(history, reference), 1e-9 * largest(reference));
}

TEST(Surfaces, MayBeSwapped) {
  const auto reference = tip_history({});
  const auto swapped =
      tip_history({{"contact.interface.master", "lower_face"}, {"contact.interface.slave", "upper_face"}});
  EXPECT_LT(largest_difference(swapped, reference), 0.005 * largest(reference));
}

/// Another way to see the same beams: a choice of the deck that a finer mesh makes irrelevant.
class SameBeams : public testing::TestWithParam<Changes> {};

TEST_P(SameBeams, MoveTheSameToOneHundredth) {
  const auto reference = tip_history({});
  const auto history = tip_history(GetParam());
  EXPECT_LT(largest_difference(history, reference), 0.01 * largest(reference));
}

INSTANTIATE_TEST_SUITE_P(Normals, SameBeams,
                         testing::Values(Changes{{"contact.interface.normal", "slave"}},
                                         Changes{{"contact.interface.normal", "average"}}),
                         [](const auto& instance) { return instance.param.front().value; });
} // namespace
} // namespace rubato::step
