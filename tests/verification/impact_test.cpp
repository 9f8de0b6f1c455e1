// SPDX-License-Identifier: LGPL-3.0-or-later
/// V1, V2, V8 and V10: what the contact-safe schemes make of impacts whose theory is exact.
#include <gtest/gtest.h>

#include "verification/impact.hpp"
#include <ostream>
#include <string>

namespace rubato::verification::impact_test {
namespace {

constexpr double closed = 1e-10;

struct ImpactCase {
  const char* name;
  const char* deck;
  const char* zone;
  ImpactTheory (*theory)();
  const char* run;
  const char* probe = nullptr; ///< a column of the probes, where histories are compared
};

void PrintTo(const ImpactCase& chosen, std::ostream* out) {
  *out << chosen.deck << ", " << chosen.run;
}

class ElasticImpact : public testing::TestWithParam<ImpactCase> {
protected:
  CaseRuns runs_{GetParam().deck};
  const CaseRun& run_ = runs_[GetParam().run];
  ImpactTheory theory_ = GetParam().theory();
  Impact found_ = measure_impact(run_, GetParam().zone, theory_);
};

class MasslessSurface : public ElasticImpact {};
class MoreausImpact : public ElasticImpact {};
class MortarImpact : public ElasticImpact {};
class SafeImpact : public ElasticImpact {};
class TimelyImpact : public ElasticImpact {};

TEST_P(MasslessSurface, KeepsItsEnergy) {
  EXPECT_LE(found_.energy_error, 1e-3);
}

/// The law stops the nodes that touch without giving anything back (restitution 0): what they moved with is
/// lost, a part that falls with cells and steps.
TEST_P(MoreausImpact, LosesWhatTheNodesThatTouchBring) {
  EXPECT_LE(run_.result.energy.gain, 1e-9 * theory_.energy);
  EXPECT_LE(found_.energy_error, 1e-2);
}

TEST_P(MortarImpact, GainsNothingAndKeepsItsEnergyUpToRounding) {
  EXPECT_EQ(run_.study.time.scheme, study::SchemeKind::moreau_jean);
  EXPECT_LE(run_.result.energy.gain, 1e-9 * theory_.energy);
  EXPECT_LE(found_.energy_error, 1e-9);
  EXPECT_LE(run_.ledger(), closed);
}

/// The bodies move along one axis: their faces meet as the nodes of matching faces do.
TEST_P(MortarImpact, IsThatOfPointsOnTheNodes) {
  const auto& by_nodes = runs_["default"];
  const auto name = GetParam().probe;
  const auto mortar = column(run_.probes, name);
  const auto nodes = column(by_nodes.probes, name);
  ASSERT_EQ(mortar.size(), nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    EXPECT_NEAR(mortar[i], nodes[i], 1e-9) << i;
}

TEST_P(SafeImpact, PressesAsTheWaveDoes) {
  EXPECT_LE(found_.pressure_error, 0.06);
}

TEST_P(TimelyImpact, BeginsAndEndsWithinAStep) {
  const double step = run_.study.time.step * (1 + 1e-9);
  EXPECT_NEAR(found_.begin, theory_.begin, step);
  EXPECT_NEAR(found_.end, theory_.end, step);
}

const ImpactCase bar_redistributed{"BarOnWallRedistributed", "v1_bar_on_wall/bar.yaml", "wall", bar_on_wall,
                                   "redistributed"};
const ImpactCase bar_moreau{"BarOnWallMoreauJean", "v1_bar_on_wall/bar.yaml", "wall", bar_on_wall,
                            "moreau_jean"};
const ImpactCase dropped_redistributed{"DroppedBarRedistributed", "v2_dropped_bar/bar.yaml", "wall",
                                       dropped_bar, "redistributed"};
const ImpactCase dropped_moreau{"DroppedBarMoreauJean", "v2_dropped_bar/bar.yaml", "wall", dropped_bar,
                                "moreau_jean"};
const ImpactCase rods_redistributed{"RodOnRodRedistributed", "v10_rod_on_rod/rods.yaml", "interface",
                                    rod_on_rod, "redistributed"};
const ImpactCase rods_redistributed_hht{"RodOnRodRedistributedHht", "v10_rod_on_rod/rods.yaml", "interface",
                                        rod_on_rod, "redistributed_hht"};
const ImpactCase rods_moreau{"RodOnRodMoreauJean", "v10_rod_on_rod/rods.yaml", "interface", rod_on_rod,
                             "moreau_jean"};

const ImpactCase bar_default{"BarOnWallDefault", "v1_bar_on_wall/bar.yaml", "wall", bar_on_wall, "default"};
const ImpactCase dropped_default{"DroppedBarDefault", "v2_dropped_bar/bar.yaml", "wall", dropped_bar,
                                 "default"};
const ImpactCase rods_default{"RodOnRodDefault", "v10_rod_on_rod/rods.yaml", "interface", rod_on_rod,
                              "default"};

const ImpactCase bar_mortar{"BarOnWallMortar", "v1_bar_on_wall/bar.yaml", "wall", bar_on_wall, "mortar",
                            "tail.x"};
const ImpactCase dropped_mortar{
    "DroppedBarMortar", "v2_dropped_bar/bar.yaml", "wall", dropped_bar, "mortar", "tail.x"};
const ImpactCase rods_mortar{"RodOnRodMortar", "v10_rod_on_rod/rods.yaml", "interface", rod_on_rod, "mortar",
                             "tail.x"};
const ImpactCase rods_nonmatching{"RodOnRodThreeFacesOnTwo",
                                  "v10_rod_on_rod/rods.yaml",
                                  "interface",
                                  rod_on_rod,
                                  "mortar_nonmatching",
                                  "tail.x"};

const auto name_of = [](const auto& chosen) { return std::string(chosen.param.name); };

INSTANTIATE_TEST_SUITE_P(Of, MasslessSurface,
                         testing::Values(bar_redistributed, dropped_redistributed, rods_redistributed,
                                         bar_default, dropped_default, rods_default),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Of, MoreausImpact, testing::Values(bar_moreau, dropped_moreau, rods_moreau),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Of, MortarImpact,
                         testing::Values(bar_mortar, dropped_mortar, rods_mortar, rods_nonmatching), name_of);
// The master of V10 keeps its mass: without numerical damping its surface still swings.
INSTANTIATE_TEST_SUITE_P(Of, SafeImpact,
                         testing::Values(bar_redistributed, bar_moreau, bar_default, dropped_redistributed,
                                         dropped_moreau, dropped_default, rods_redistributed_hht, rods_moreau,
                                         rods_default, bar_mortar, dropped_mortar, rods_mortar,
                                         rods_nonmatching),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Of, TimelyImpact,
                         testing::Values(bar_redistributed, bar_moreau, bar_default, dropped_redistributed,
                                         dropped_moreau, dropped_default, rods_redistributed,
                                         rods_redistributed_hht, rods_moreau, rods_default, bar_mortar,
                                         dropped_mortar, rods_mortar, rods_nonmatching),
                         name_of);

/// Whatever their energy does.
class Impacts : public testing::TestWithParam<const char*> {};

TEST_P(Impacts, HaveLedgersThatCloseWithEveryScheme) {
  CaseRuns runs(GetParam());
  for (const auto& name : runs.names())
    EXPECT_LE(runs[name].ledger(), closed) << name;
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
  for (const auto* name : {"redistributed", "moreau_jean", "default"}) {
    const auto found = measure_sphere(runs[name]);
    EXPECT_NEAR(found.force, theory.force, 0.03 * theory.force) << name;
    EXPECT_NEAR(found.approach, theory.approach, 0.03 * theory.approach) << name;
    EXPECT_NEAR(found.duration, theory.duration, 0.03 * theory.duration) << name;
  }
}

} // namespace
} // namespace rubato::verification::impact_test
