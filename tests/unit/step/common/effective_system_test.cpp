// SPDX-License-Identifier: LGPL-3.0-or-later
// What a cut step changes, and what it must leave alone.
#include "rubato/step/common/effective_system.hpp"
#include "rubato/study/study.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <string>

namespace rubato::step::effective_system_test {
namespace {

/// The coefficients of a whole step and of a part so short that inertia outweighs stiffness.
class CutStep {
public:
  explicit CutStep(const std::string& method)
      : walk_(test::two_beams, {{"contact.interface.method", method}}) {}

  contact::ZoneCoefficients whole() const { return of(walk_.model.study.time.step); }
  contact::ZoneCoefficients part() const { return of(walk_.model.study.time.step / 1024); }

private:
  contact::ZoneCoefficients of(double step) const {
    return make_effective_system(walk_.model, walk_.scheme, step).zones.front();
  }
  test::Walk walk_;
};

TEST(CutSteps, HaveTheSpringsOfTheWholeStep) {
  for (const char* method : {"penalty", "nodal_penalty"}) {
    const CutStep cut(method);
    EXPECT_EQ(cut.part().normal, cut.whole().normal) << method;
    EXPECT_EQ(cut.part().tangential, cut.whole().tangential) << method;
  }
  const CutStep cut("nodal_lagrange");
  EXPECT_EQ(cut.part().tangential, cut.whole().tangential);
  EXPECT_GT(cut.part().normal[5], 10 * cut.whole().normal[5]);
}

TEST(CutSteps, HaveAugmentationsOfTheirOwn) {
  const CutStep cut("augmented_lagrangian");
  EXPECT_GT(cut.part().normal[5], 10 * cut.whole().normal[5]);
}

} // namespace
} // namespace rubato::step::effective_system_test
