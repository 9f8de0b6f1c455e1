// SPDX-License-Identifier: LGPL-3.0-or-later
/// How Newton converges, and what its answer must not depend on.
#include "rubato/deck/read.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/common/newton.hpp"
#include "rubato/step/full/whole_system.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::step::newton_test {
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

/// A soft block that its top drags along the plane, by a twentieth of its length in each of two steps: it
/// leans, its foot turns, and its nodes come to lie on other places of the master.
Changes dragged(const char* friction) {
  return {{"materials.stone.young", "5e4"},
          {"supports.1.x.value", "0.1"},
          {"contact.foot.friction", friction},
          {"time.step", "0.5"},
          {"newton.residual", "1e-13"}};
}

struct Iterates {
  std::vector<double> residuals; ///< relative, after 1, 2, … iterations
  State end;
};

/// Of the second step, from the first one's statuses; each iterate from a run that is stopped there.
Iterates iterates_of(Changes changes) {
  Walk walk(test::block_on_plane, changes);
  EXPECT_TRUE(walk.advance());
  Iterates found;
  for (int iterations = 1; iterations < 20; ++iterations) {
    auto study = walk.model.study;
    study.newton.max_iterations = iterations;
    const test::BuiltModel model(study);
    auto system = make_effective_system(model, walk.scheme, walk.length());
    const double t = walk.target();
    found.end = predict(model, walk.scheme, system, walk.state(), t);
    ContactEvaluator side(model, walk.scheme, system, walk.state(), {.start = Start::last_step});
    Progress progress;
    WholeSystem whole(model, walk.scheme, system, walk.state(), t, side, progress);
    const auto report = run_newton(whole, iterations, progress, found.end, Frozen(model.zones.size()));
    found.residuals.push_back(report.residual);
    if (report.converged())
      break;
  }
  return found;
}

class NewtonOnASlidingContact : public testing::TestWithParam<const char*> {};

/// r_{k+1} ≤ C r_k² down to rounding, with a C of the problem's own size.
TEST_P(NewtonOnASlidingContact, ConvergesQuadratically) {
  const auto found = iterates_of(dragged(GetParam()));
  ASSERT_LT(found.residuals.size(), 19u);
  for (const auto status : found.end.zones.front().status)
    EXPECT_EQ(status, contact::Status::slip);
  int quadratic = 0;
  for (std::size_t k = 0; k + 1 < found.residuals.size(); ++k) {
    const double now = found.residuals[k], next = found.residuals[k + 1];
    if (now > 1e-1 || now < 1e-6)
      continue;
    EXPECT_LT(next, 10 * now * now + 1e-12) << "after iteration " << k + 2;
    ++quadratic;
  }
  EXPECT_GE(quadratic, 2);
}

INSTANTIATE_TEST_SUITE_P(Friction, NewtonOnASlidingContact, testing::Values("0", "0.2"),
                         [](const auto& instance) { return instance.index == 0 ? "None" : "Some"; });

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
} // namespace rubato::step::newton_test
