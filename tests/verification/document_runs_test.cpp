// SPDX-License-Identifier: LGPL-3.0-or-later
/// The document's runs evol2 to evol5, by every algorithm it names, against a running Code_Aster on the
/// original meshes: up to the first step that it cut, from which on its list of instants is another one.
#include "rubato/results/history.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verification/modelings.hpp"
#include "verification/sdnl140.hpp"
#include <algorithm>
#include <cmath>
#include <ostream>

namespace rubato::verification::document_runs_test {
namespace {

using Changes = std::vector<deck::Setting>;

constexpr double step = 1e-3;

/// `tolerance` of the history's peak; `until`: nothing is compared beyond.
struct DocumentRun {
  char letter;
  std::string run;
  double tolerance;
  double until = 0.012;
};

void PrintTo(const DocumentRun& wanted, std::ostream* out) {
  *out << wanted.letter << '_' << wanted.run;
}

class Document : public testing::TestWithParam<DocumentRun> {};

TEST_P(Document, RunIsCodeAsters) {
  const auto& [letter, run, tolerance, latest] = GetParam();
  const auto reference = history(fmt::format("{}_{}", letter, run));
  if (!reference || !has_original_mesh(letter))
    GTEST_SKIP() << "the reference histories are not there";
  auto study = study_of(letter, run);
  study.time.end = std::min(latest, last_whole_step(*reference, step));
  const auto finished = finish(study);
  ASSERT_EQ(finished.result.status, run::Status::complete) << finished.result.message;
  const auto found = deviation(finished.probes, *reference, study.time.end * (1 + 1e-9));
  EXPECT_EQ(found.missing, 0);
  EXPECT_GT(found.instants, 1);
  EXPECT_LE(found.relative(), tolerance) << "at t = " << found.at;
  RecordProperty("largest_deviation_over_peak", fmt::format("{:.2e}", found.relative()));
}

std::string name_of(const testing::TestParamInfo<DocumentRun>& info) {
  return fmt::format("{}_{}", info.param.letter, info.param.run);
}

/// The geometry loop ends where Code_Aster's ends, so that even its coarse answer is the same.
INSTANTIATE_TEST_SUITE_P(PartialNewton, Document,
                         testing::Values(DocumentRun{'a', "evol2", 1e-8}, DocumentRun{'b', "evol2", 1e-8},
                                         DocumentRun{'c', "evol2", 1e-10}, DocumentRun{'d', "evol2", 1e-8},
                                         DocumentRun{'e', "evol2", 1e-10}, DocumentRun{'f', "evol2", 1e-10}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(Penalty, Document,
                         testing::Values(DocumentRun{'a', "evol3", 1e-5},
                                         DocumentRun{'b', "evol3", 1e-5, 0.002},
                                         DocumentRun{'c', "evol3", 1e-5},
                                         DocumentRun{'d', "evol3", 1e-5, 0.006},
                                         DocumentRun{'e', "evol3", 1e-5}, DocumentRun{'f', "evol3", 1e-5}),
                         name_of);

/// Code_Aster's evol4 of A is 7e-5 of the peak away from its own evol3, which has the same answer: its
/// Newton loops ended at a residual of 1e-4. rubato's two agree, see below.
INSTANTIATE_TEST_SUITE_P(PenaltyByFixedPoint, Document,
                         testing::Values(DocumentRun{'a', "evol4", 1e-4}, DocumentRun{'b', "evol4", 1e-5},
                                         DocumentRun{'c', "evol4", 1e-6},
                                         DocumentRun{'d', "evol4", 1e-5, 0.006},
                                         DocumentRun{'e', "evol4", 1e-5}, DocumentRun{'f', "evol4", 1e-6}),
                         name_of);

INSTANTIATE_TEST_SUITE_P(NodalPenalty, Document,
                         testing::Values(DocumentRun{'a', "evol5", 5e-5},
                                         DocumentRun{'b', "evol5", 5e-5, 0.002},
                                         DocumentRun{'c', "evol5", 5e-5},
                                         DocumentRun{'d', "evol5", 5e-5, 0.010},
                                         DocumentRun{'e', "evol5", 5e-5}, DocumentRun{'f', "evol5", 5e-5}),
                         name_of);

double apart(const study::Study& one, const study::Study& other) {
  return largest_difference(finish(one), finish(other));
}

class Modelings : public testing::TestWithParam<char> {};

TEST_P(Modelings, EndAtTheSameAnswerByPartialNewtonWhenItsGeometryIsSettled) {
  auto settled = study_of(GetParam(), "evol2");
  settled.contact.front().geometry = {study::Iteration::fixed_point, 1e-9, 60};
  EXPECT_LT(apart(settled, study_of(GetParam(), "evol1")), 1e-6);
}

TEST_P(Modelings, EndAtTheSameAnswerByPenaltyWhicheverLevelsLoop) {
  auto evol3 = study_of(GetParam(), "evol3");
  auto evol4 = study_of(GetParam(), "evol4");
  evol3.time.end = evol4.time.end = 0.005; // before the first cut
  EXPECT_LT(apart(evol4, evol3), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Sdnl140, Modelings, testing::Values('a', 'c', 'e', 'f'),
                         [](const auto& modeling) { return std::string(1, modeling.param); });

TEST(PublishedLagrangian, IsNodalLagrangeOfModelingA) {
  if (!has_original_mesh('a'))
    GTEST_SKIP() << "the original mesh is not there";
  auto study = study_of('a', "evol5",
                        {{"runs.evol5.contact.interface.method", "nodal_lagrange"},
                         {"runs.evol5.contact.interface.coefficients", "{tangential: 1e6}"}});
  study.time.end = step;
  const auto finished = finish(study);
  ASSERT_EQ(finished.result.status, run::Status::complete);
  const double found = finished.probes.rows.back()[static_cast<std::size_t>(finished.probes.column("tip.y"))];
  EXPECT_NEAR(found, published('a', "evol5", 0.001).value(), 1e-5 * 0.011);
}

TEST(FrictionlessActiveSet, IsNodalLagrange) {
  for (const auto* name : {"f_frictionless_active_set", "f_frictionless_active_set_newmark"}) {
    const auto reference = history(name);
    if (!reference)
      GTEST_SKIP() << "the reference histories are not there";
    Changes changes{{"contact.interface.friction", "0"},
                    {"runs.evol5.contact.interface.method", "nodal_lagrange"},
                    {"runs.evol5.contact.interface.coefficients", "~"}};
    if (std::string(name).ends_with("newmark"))
      changes.insert(changes.end(), {{"time.scheme", "newmark"}, {"time.alpha", "~"}});
    for (const auto* method : {"nodal_lagrange", "nodal_pcg"}) {
      changes[1].value = method;
      const auto finished = finish(study_of('f', "evol5", changes));
      ASSERT_EQ(finished.result.status, run::Status::complete) << name << ' ' << method;
      EXPECT_LE(deviation(finished.probes, *reference).relative(), 1e-8) << name << ' ' << method;
    }
  }
}

/// One cell on two over the height of a beam is enough for quadratic ones; the step must be fine.
TEST(Convergence, ComesToTheAnswerOfAnIndependentExplicitComputation) {
  const auto deck = deck::read_deck(RUBATO_SOURCE_DIR "/cases/sdnl140/convergence.yaml");
  const auto study = std::ranges::find(deck.runs, "mesh1_step2e-5", &study::Study::name);
  ASSERT_NE(study, deck.runs.end());
  const auto finished = finish(*study);
  ASSERT_EQ(finished.result.status, run::Status::complete) << finished.result.message;
  constexpr double hundredth_of_peak = 0.00186;
  const auto column = finished.probes.column("tip.y");
  EXPECT_NEAR(results::value_at(finished.probes, column, 0.001).value(), -0.0180, hundredth_of_peak);
  EXPECT_NEAR(results::value_at(finished.probes, column, 0.006).value(), -0.1855, hundredth_of_peak);
  EXPECT_NEAR(results::value_at(finished.probes, column, 0.012).value(), -0.0079, hundredth_of_peak);
}

} // namespace
} // namespace rubato::verification::document_runs_test
