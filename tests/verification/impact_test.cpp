// SPDX-License-Identifier: LGPL-3.0-or-later
/// V1, V2, V8 and V10: what the contact-safe schemes make of impacts whose theory is exact.
#include <gtest/gtest.h>

#include "verification/impact.hpp"

namespace rubato::verification {
namespace {

constexpr double closed = 1e-10;

struct ImpactCase {
  const char* name;
  const char* deck;
  const char* zone;
  ImpactTheory (*theory)();
  const char* run;
};

class ElasticImpact : public testing::TestWithParam<ImpactCase> {
protected:
  CaseRuns runs_{GetParam().deck};
  const CaseRun& run_ = runs_[GetParam().run];
  ImpactTheory theory_ = GetParam().theory();
  Impact found_ = measure_impact(run_, GetParam().zone, theory_);
};

TEST_P(ElasticImpact, KeepsItsEnergy) {
  EXPECT_LE(found_.energy_error, 1e-3);
}

TEST_P(ElasticImpact, PressesAsTheWaveDoes) {
  EXPECT_LE(found_.pressure_error, 0.06);
}

TEST_P(ElasticImpact, BeginsAndEndsWithinAStep) {
  const double step = run_.study.time.step;
  EXPECT_NEAR(found_.begin, theory_.begin, step * (1 + 1e-9));
  EXPECT_NEAR(found_.end, theory_.end, step * (1 + 1e-9));
}

TEST_P(ElasticImpact, HasALedgerThatCloses) {
  EXPECT_LE(run_.ledger(), closed);
}

const std::vector<ImpactCase> safe_runs{
    {"BarOnWallRedistributed", "v1_bar_on_wall/bar.yaml", "wall", bar_on_wall, "redistributed"},
    {"BarOnWallMoreauJean", "v1_bar_on_wall/bar.yaml", "wall", bar_on_wall, "moreau_jean"},
    {"DroppedBarRedistributed", "v2_dropped_bar/bar.yaml", "wall", dropped_bar, "redistributed"},
    {"DroppedBarMoreauJean", "v2_dropped_bar/bar.yaml", "wall", dropped_bar, "moreau_jean"},
    {"RodOnRodRedistributed", "v10_rod_on_rod/rods.yaml", "interface", rod_on_rod, "redistributed"},
    {"RodOnRodMoreauJean", "v10_rod_on_rod/rods.yaml", "interface", rod_on_rod, "moreau_jean"}};

INSTANTIATE_TEST_SUITE_P(Of, ElasticImpact, testing::ValuesIn(safe_runs),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

/// Every other scheme's ledger closes too, whatever its energy does.
class Impacts : public testing::TestWithParam<const char*> {};

TEST_P(Impacts, HaveLedgersThatCloseWithEveryImplicitScheme) {
  CaseRuns runs(GetParam());
  for (const auto& name : runs.names()) {
    if (deck::is_explicit(runs[name].study.time.scheme))
      continue;
    EXPECT_LE(runs[name].ledger(), closed) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Impacts,
                         testing::Values("v1_bar_on_wall/bar.yaml", "v2_dropped_bar/bar.yaml",
                                         "v8_hertz_impact/sphere.yaml", "v10_rod_on_rod/rods.yaml"),
                         [](const auto& chosen) {
                           const std::string deck = chosen.param;
                           return deck.substr(0, deck.find('_'));
                         });

TEST(SphereOnWall, IsHertzsImpact) {
  CaseRuns runs("v8_hertz_impact/sphere.yaml");
  const auto theory = hertz_impact(10, 210e3, 0.3, 7.8e-9, 1000);
  EXPECT_NEAR(theory.force, 2301, 1);
  EXPECT_NEAR(theory.duration, 52.2e-6, 1e-7);
  for (const auto* name : {"redistributed", "moreau_jean"}) {
    const auto found = measure_sphere(runs[name]);
    EXPECT_NEAR(found.force, theory.force, 0.03 * theory.force) << name;
    EXPECT_NEAR(found.approach, theory.approach, 0.03 * theory.approach) << name;
    EXPECT_NEAR(found.duration, theory.duration, 0.03 * theory.duration) << name;
  }
}

} // namespace
} // namespace rubato::verification
