// SPDX-License-Identifier: LGPL-3.0-or-later
/// Explicit runs of modeling F against implicit ones, and against what both must come to (docs: sdnl140).
#include <gtest/gtest.h>

#include "verification/sdnl140.hpp"
#include <algorithm>
#include <cmath>

namespace rubato::verification::explicit_test {
namespace {

const std::vector<deck::Setting> explicit_steps{{"time.scheme", "central_difference"},
                                                {"time.alpha", ""},
                                                {"time.step", "auto"},
                                                {"time.start", ""},
                                                {"time.record", "1e-3"},
                                                {"checks", ""}};

std::vector<deck::Setting> joined(std::vector<deck::Setting> first,
                                  const std::vector<deck::Setting>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

double tip(const Finished& run, double t) {
  const auto column = static_cast<std::size_t>(run.probes.column("tip.y"));
  const auto row =
      std::ranges::find_if(run.probes.rows, [&](const auto& r) { return std::abs(r[0] - t) < 1e-9; });
  return row == run.probes.rows.end() ? std::nan("") : (*row)[column];
}

/// Refined by 2, the mesh hides little of the difference between lumped and consistent mass.
TEST(ExplicitModelingF, AgreesWithFineImplicitStepsWithoutContact) {
  const auto on_mesh = joined(without_contact(), {{"mesh.refine", "2"}});
  const auto explicit_run = finish(sdnl140('f', MeshFrom::generator, joined(on_mesh, explicit_steps)));
  const auto implicit_run = finish(sdnl140('f', MeshFrom::generator,
                                           joined(on_mesh, {{"time.scheme", "newmark"},
                                                            {"time.alpha", ""},
                                                            {"time.step", "1e-5"},
                                                            {"time.start", ""},
                                                            {"checks", ""}})));
  for (const double t : {0.001, 0.006, 0.012})
    EXPECT_NEAR(tip(explicit_run, t), tip(implicit_run, t), 0.005 * 0.4) << t;
}

/// With contact: another mass matrix, another contact method, no iterations.
TEST(ExplicitModelingF, AgreesWithFineImplicitSteps) {
  const std::vector<deck::Setting> shorter{
      {"time.end", "0.006"}, {"runs.implicit.time.step", "2e-5"}, {"runs.implicit.checks", "~"}};
  const auto deck = deck::read_deck(RUBATO_SOURCE_DIR "/cases/sdnl140/explicit.yaml", shorter);
  const auto explicit_run = finish(deck.runs.front());
  const auto implicit_run = finish(deck.runs.back());
  for (const double t : {0.001, 0.002, 0.004, 0.006})
    EXPECT_NEAR(tip(explicit_run, t), tip(implicit_run, t), 0.005 * 0.184) << t;
}

TEST(ExplicitModelingF, WithQuadraticCellsGivesTheTrueAnswer) {
  const auto run = finish(sdnl140('f', MeshFrom::generator,
                                  joined(explicit_steps, {{"mesh.convert", "full_quadratic"},
                                                          {"contact.interface.method", "penalty"},
                                                          {"contact.interface.friction_method", ""}})));
  ASSERT_EQ(run.result.status, run::Status::complete);
  EXPECT_LE(run.result.energy.largest_balance, 1e-10 * run.result.energy.largest);
  constexpr double peak = 0.1856;
  EXPECT_NEAR(tip(run, 0.001), -0.0180, 0.01 * peak);
  EXPECT_NEAR(tip(run, 0.006), -0.1855, 0.01 * peak);
  EXPECT_NEAR(tip(run, 0.012), -0.0079, 0.01 * peak);
}

} // namespace
} // namespace rubato::verification::explicit_test
