// SPDX-License-Identifier: LGPL-3.0-or-later
// The ledger of energies closes in SDNL140's runs, whatever the modeling, the scheme and the method.
#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "support/shared_files.hpp"
#include "verification/modelings.hpp"
#include "verification/sdnl140.hpp"
#include <string>
#include <vector>

namespace rubato::verification::energy_test {
namespace {

constexpr double closed = 1e-10;

void expect_closed(const study::Study& study) {
  const auto result = finish(study).result;
  EXPECT_EQ(result.status, run::Status::complete) << result.message;
  EXPECT_GT(result.energy.largest, 0);
  EXPECT_LE(result.energy.largest_balance, closed * result.energy.largest);
}

class EnergyOfModeling : public testing::TestWithParam<char> {};

TEST_P(EnergyOfModeling, ClosesOnTheOriginalMeshOrItsOwn) {
  expect_closed(study_of(GetParam(), "evol1"));
}

INSTANTIATE_TEST_SUITE_P(Sdnl140, EnergyOfModeling, testing::Values('a', 'c', 'd', 'e', 'f'),
                         [](const auto& chosen) { return std::string(1, chosen.param); });

struct Variation {
  std::string name;
  std::vector<deck::Setting> changes;
};

class EnergyOfModelingF : public testing::TestWithParam<Variation> {};

TEST_P(EnergyOfModelingF, Closes) {
  expect_closed(sdnl140('f', MeshFrom::generator, GetParam().changes));
}

const std::vector<Variation> variations{
    {"Newmark", {{"time.scheme", "newmark"}, {"time.alpha", ""}}},
    {"GeneralizedAlpha", {{"time.scheme", "generalized_alpha"}, {"time.alpha", ""}}},
    {"WbzAlpha", {{"time.scheme", "wbz_alpha"}}},
    {"ModifiedAverageAcceleration", {{"time.scheme", "modified_average_acceleration"}}},
    {"Static", {{"time.scheme", "static"}, {"time.alpha", ""}, {"time.start", ""}}},
    {"ConsistentStart", {{"time.start", "consistent"}}},
    {"Damping", {{"materials.steel.rayleigh", "{stiffness: 1e-5, mass: 10}"}}},
    {"WholeSystem", {{"solver", "full"}}},
    {"Penalty", {{"contact.interface.method", "penalty"}}},
    {"FrictionByPenalty", {{"contact.interface.friction_method", "penalty"}}},
    {"NodalLagrange", {{"contact.interface.method", "nodal_lagrange"}, {"time.end", "0.006"}}},
    {"NodalPenalty", {{"contact.interface.method", "nodal_penalty"}}},
    {"NodalPcg", {{"contact.interface.method", "nodal_pcg"}, {"contact.interface.friction", "0"}}},
    {"ForgottenContactForces",
     {{"contact.interface.method", "nodal_penalty"}, {"contact.interface.history_force", "false"}}},
    {"GeometryInALoop", {{"contact.interface.iterate", "{geometry: fixed_point}"}}},
};

INSTANTIATE_TEST_SUITE_P(By, EnergyOfModelingF, testing::ValuesIn(variations),
                         [](const auto& chosen) { return chosen.param.name; });

std::vector<std::string> warnings_of(const study::Study& study) {
  const test::ScratchFolder folder;
  std::vector<std::string> warnings;
  run::Watch watch;
  watch.warn = [&](const std::string& text) { warnings.push_back(text); };
  run::run_study(study, folder / "run", watch);
  return warnings;
}

class DocumentedRun : public testing::TestWithParam<std::string> {};

TEST_P(DocumentedRun, GainsNothingWorthAWarning) {
  for (const char letter : {'c', 'e', 'f'})
    for (const auto& warning : warnings_of(study_of(letter, GetParam())))
      EXPECT_EQ(warning.find("energy gained"), std::string::npos) << letter << ": " << warning;
}

INSTANTIATE_TEST_SUITE_P(Sdnl140, DocumentedRun, testing::Values("evol1", "evol2", "evol3", "evol4", "evol5"),
                         [](const auto& chosen) { return chosen.param; });

TEST(UndampedNewmark, WarnsLongBeforeExactContactBlowsItUp) {
  auto warnings = warnings_of(
      study_of('f', "evol1", {{"time.scheme", "newmark"}, {"time.alpha", ""}, {"time.end", "0.06"}}));
  std::erase_if(warnings, [](const auto& text) {
    return text.find("too stiff in bending") != text.npos || text.find("small strain") != text.npos ||
           text.find("step_in_period") != text.npos || text.find("friction_gain") != text.npos;
  });
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_TRUE(warnings[0].starts_with("evol1: newmark without damping gains energy")) << warnings[0];
  EXPECT_TRUE(warnings[1].starts_with("evol1: energy gained from t = ")) << warnings[1];
  EXPECT_NE(warnings[1].find("contact pressures of contact.interface gave"), std::string::npos)
      << warnings[1];
}

} // namespace
} // namespace rubato::verification::energy_test
