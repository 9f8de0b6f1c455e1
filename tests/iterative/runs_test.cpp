// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/conjugate_gradients.hpp"
#include "rubato/results/csv.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "restart/same_results.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::runs_test {
namespace {

using test::with;

class IterativeRun : public testing::Test {
protected:
  void SetUp() override {
    if (!linalg::has_conjugate_gradients())
      GTEST_SKIP() << "rubato is built without PETSc";
  }

  test::Outcome run(const std::string& deck, const std::string& output,
                    std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"run", deck, "-o", output});
    return test::run_program(more, folder_.path());
  }

  nlohmann::json summary(const std::string& run) const {
    return nlohmann::json::parse(test::text_of(folder_ / (run + "/run.json")));
  }

  /// The largest difference of all probes, of the largest of their values.
  double difference(const std::string& one, const std::string& other) const {
    const auto a = results::read_csv(folder_ / (one + "/probes.csv"));
    const auto b = results::read_csv(folder_ / (other + "/probes.csv"));
    EXPECT_EQ(a.rows.size(), b.rows.size());
    double largest = 0, peak = 0;
    for (std::size_t i = 0; i < std::min(a.rows.size(), b.rows.size()); ++i)
      for (std::size_t k = 1; k < a.rows[i].size(); ++k) {
        largest = std::max(largest, std::abs(a.rows[i][k] - b.rows[i][k]));
        peak = std::max(peak, std::abs(b.rows[i][k]));
      }
    return largest / peak;
  }

  /// By iterations and by a factor, with the same changes: as many steps, and the same histories.
  void expect_alike(const std::string& deck, const std::string& name,
                    std::vector<std::string> more = {}) const {
    more.insert(more.end(), {"--set", "fields=~", "--set", "checks=~", "--set", "newton.residual=1e-10",
                             "--set", "solver=condensed"});
    const auto direct = run(deck, "direct", more);
    ASSERT_EQ(direct.exit_code, 0) << direct.err;
    more.back() = "solver=iterative";
    const auto iterative = run(deck, "iterative", more);
    ASSERT_EQ(iterative.exit_code, 0) << iterative.err;
    EXPECT_NE(iterative.err.find("conjugate gradients"), std::string::npos) << iterative.err;
    EXPECT_EQ(summary("iterative/" + name).at("steps"), summary("direct/" + name).at("steps"));
    EXPECT_EQ(summary("iterative/" + name).at("study").at("solver"), "iterative");
    EXPECT_TRUE(summary("iterative/" + name).at("method").get<std::string>().starts_with("solver iterative"));
    EXPECT_LT(difference("iterative/" + name, "direct/" + name), 1e-8);
  }

  static std::string case_of(const std::string& letter) {
    return std::string(RUBATO_SOURCE_DIR) + "/cases/sdnl140/" + letter + ".yaml";
  }

  test::ScratchFolder folder_;
};

TEST_F(IterativeRun, OfHexahedraThatRubIsThatByAFactor) {
  expect_alike(case_of("c"), "evol1",
               {"--only", "evol1", "--set", "mesh.refine=2", "--set", "time.end=0.003"});
}

TEST_F(IterativeRun, InThePlaneIsThatByAFactor) {
  expect_alike(case_of("f"), "evol1", {"--only", "evol1", "--set", "mesh.refine=4"});
}

/// One body, held in its plane of symmetry, that yields: its tangent changes from iteration to iteration.
const std::string plastic_block = R"(mesh:
  generate:
    - name: block
      box: {from: [0, 0, 0], to: [1, 1, 2]}
      divisions: [5, 5, 9]
      sides: {left: plane_x, back: plane_z, bottom: plane_y, right: pulled}
physics: solid
materials:
  metal: {law: plastic, young: 200e9, poisson: 0.3, density: 7800, hardening: {linear: {yield_stress: 200e6, modulus: 2e9}}, cells: all}
supports:
  - {on: plane_x, fix: [x]}
  - {on: plane_y, fix: [y]}
  - {on: plane_z, fix: [z]}
loads:
  - surface_force: {on: pulled, x: 230e6, y: 20e6, function: ramp}
functions: {ramp: {ramp: [0, 1]}}
time: {scheme: static, step: 0.25, end: 1}
probes:
  corner: {point: [1, 1, 2]}
)";

TEST_F(IterativeRun, OfABlockThatYieldsIsThatByAFactor) {
  test::write_text(folder_ / "block.yaml", plastic_block);
  expect_alike("block.yaml", "run");
}

const std::string fine_blocks =
    with(with(test::two_blocks, "divisions: [4, 2]\n      sides: {left: held, bottom",
              "divisions: [40, 10]\n      sides: {left: held, bottom"),
         "divisions: [4, 2]\n      sides: {left: held, top",
         "divisions: [40, 10]\n      sides: {left: held, top") +
    "solver: iterative\nfields: {formats: [vtu], every: 3, last: false}\n";

TEST_F(IterativeRun, GoesOnToTheSameBits) {
  test::write_text(folder_ / "deck.yaml", fine_blocks);
  const auto longer = run("deck.yaml", "whole", {"--set", "time.end=8e-4"});
  ASSERT_EQ(longer.exit_code, 0) << longer.err;
  ASSERT_EQ(run("deck.yaml", "out").exit_code, 0);
  const auto outcome = run("deck.yaml", "out", {"--resume", "--set", "time.end=8e-4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  test::expect_same_results(folder_ / "whole", folder_ / "out");
}

TEST_F(IterativeRun, IsRefusedWhereOnlyContactHoldsABody) {
  auto deck = with(fine_blocks, "scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4",
                   "scheme: static, step: 0.5, end: 1");
  deck = with(deck, "sides: {left: held, bottom: upper_face, top: roof}",
              "sides: {left: wall, bottom: upper_face, top: roof}");
  deck = with(deck, "nodal_force: {on: tip, y: -1e7}", "surface_force: {on: roof, y: -1e6}");
  test::write_text(folder_ / "deck.yaml", deck);
  const auto outcome = run("deck.yaml", "out");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find(": found iterative, but only contact holds the body of node N1 (0, 0); "
                             "expected auto, or supports or springs that hold it"),
            std::string::npos)
      << outcome.err;
}

TEST_F(IterativeRun, SaysWhatItNeedsBeforeItRuns) {
  test::write_text(folder_ / "deck.yaml", fine_blocks);
  const auto outcome = run("deck.yaml", "out", {"--dry-run"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(" of memory ("), std::string::npos) << outcome.out;
}

} // namespace
} // namespace rubato::runs_test
