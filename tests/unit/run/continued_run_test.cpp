// SPDX-License-Identifier: LGPL-3.0-or-later
// A run that starts from the end of another: static preload, then dynamics.
#include "rubato/deck/read.hpp"
#include "rubato/results/checkpoint.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/run/run_study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"

namespace rubato::run::continued_run_test {
namespace {

using test::fault_of;
using test::with;

/// It sticks and slips.
const std::string pressed = test::preloaded_blocks("2e-3");

/// A point at the limit of friction may be said to stick or to slip; open or not is certain.
std::vector<bool> open_points(const RunResult& result) {
  std::vector<bool> open;
  for (const auto status : result.end.zones.at(0).status)
    open.push_back(status == contact::Status::open);
  return open;
}

class ContinuedRun : public testing::Test {
protected:
  RunResult run(const study::Study& study, const step::State* previous = nullptr) const {
    return run_study(study, folder_ / study.name, {}, previous);
  }
  static deck::Deck deck_of(const std::string& text) { return deck::parse_deck(text, "deck.yaml"); }

  test::ScratchFolder folder_;
};

double largest(const Eigen::VectorXd& v) {
  return v.lpNorm<Eigen::Infinity>();
}

TEST_F(ContinuedRun, StaysAtRestUnderTheLoadOfItsPreload) {
  for (const auto* scheme : {"{scheme: hht, alpha: -0.1, end: 2e-3, start: {from: preload}}",
                             "{scheme: newmark, alpha: ~, end: 2e-3, start: {from: preload}}",
                             "{scheme: generalized_alpha, alpha: ~, end: 2e-3, start: {from: preload}}"}) {
    const auto deck = deck_of(with(pressed, "{end: 2e-3, start: {from: preload}}", scheme));
    const auto preload = run(deck.runs[0]);
    ASSERT_EQ(preload.status, Status::complete) << preload.message;
    EXPECT_GT(largest(preload.end.motion.u), 1e-6);
    EXPECT_GT(largest(preload.end.contact_force), 1e4);
    const auto after = run(deck.runs[1], &preload.end);
    ASSERT_EQ(after.status, Status::complete) << after.message;
    EXPECT_EQ(after.steps, 20);
    EXPECT_LE(largest(after.end.motion.u - preload.end.motion.u), 1e-10 * largest(preload.end.motion.u))
        << scheme;
    EXPECT_LE(largest(after.end.contact_force - preload.end.contact_force),
              1e-7 * largest(preload.end.contact_force));
    EXPECT_EQ(open_points(after), open_points(preload));
  }
}

TEST_F(ContinuedRun, StartsFromThePreloadsPlace) {
  const auto deck = deck_of(pressed);
  const auto preload = run(deck.runs[0]);
  run(deck.runs[1], &preload.end);
  const auto probes = results::read_csv(folder_ / "after/probes.csv");
  EXPECT_EQ(probes.rows.front().at(0), 0.0);
  EXPECT_EQ(probes.rows.front(),
            (std::vector<double>{0.0, results::read_csv(folder_ / "preload/probes.csv").rows.back()[1],
                                 results::read_csv(folder_ / "preload/probes.csv").rows.back()[2]}));
}

TEST_F(ContinuedRun, IsRefusedByTheDeckWhenItsContactIsAnother) {
  const auto refusal = [&](const std::string& change) {
    return fault_of([&] { deck_of(with(pressed, "after: {", "after: {" + change + ", ")); });
  };
  const std::string sentence = "run preload has other contact zones than run after";
  EXPECT_NE(refusal("contact: {interface: {integration: {gauss: 3}}}").find(sentence), std::string::npos);
  EXPECT_NE(refusal("contact: {interface: {friction: 0}}").find(sentence), std::string::npos);
  EXPECT_NE(refusal("contact: {interface: {slave: roof}}").find(sentence), std::string::npos);
  EXPECT_NE(refusal("contact: ~").find(sentence), std::string::npos);
  EXPECT_EQ(refusal("contact: {interface: {friction: 0.3}}"), "nothing thrown");
}

TEST_F(ContinuedRun, IsRefusedByTheDeckWhenMaterialsThatRememberAreOthers) {
  const auto flowing = with(pressed, "after: {", "after: {materials: {steel: CHANGE}, ");
  const auto refusal = [&](const std::string& both, const std::string& change) {
    return fault_of(
        [&] { deck_of(with(with(flowing, "poisson: 0.3,", "poisson: 0.3, " + both), "CHANGE", change)); });
  };
  const std::string plastic = "law: plastic, hardening: {linear: {yield_stress: 1e9, modulus: 1e9}},";
  const std::string sentence =
      "run preload has other materials than run after, expected the same of those that "
      "remember their past";
  EXPECT_NE(refusal(plastic, "{hardening: {linear: {modulus: 2e9}}}").find(sentence), std::string::npos);
  EXPECT_NE(refusal(plastic, "{strain: logarithmic}").find(sentence), std::string::npos);
  EXPECT_NE(refusal("", "{" + plastic + "}").find(sentence), std::string::npos);
  EXPECT_NE(refusal(plastic, "{law: elastic, hardening: ~}").find(sentence), std::string::npos);
  EXPECT_EQ(refusal(plastic, "{density: 1}"), "nothing thrown");
  EXPECT_EQ(refusal("", "{young: 1e11}"), "nothing thrown");
}

TEST_F(ContinuedRun, RefusesAnEndThatDoesNotFitBeforeItMakesAFolder) {
  const auto deck = deck_of(pressed);
  const auto preload = run(deck.runs[0]);
  auto finer = deck.runs[1];
  finer.mesh.refine = 2;
  auto without_contact = deck.runs[1];
  without_contact.contact.clear();
  for (const auto& study : {finer, without_contact}) {
    const auto fault = fault_of([&] { run(study, &preload.end); });
    EXPECT_NE(fault.find("run 'after' cannot start from the end of run 'preload'"), std::string::npos)
        << fault;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "after"));
  }
  EXPECT_THROW(run(deck.runs[1]), std::invalid_argument);
}

/// No step ends at 2.5e-4; the one that ends next is kept, once.
TEST_F(ContinuedRun, HasACheckpointFromTheFirstStepAtOrAfterItsInstant) {
  for (const auto& [at, kept] :
       {std::pair{"2.5e-4", 3e-4}, std::pair{"3e-4", 3e-4}, std::pair{"5e-5", 1e-4}}) {
    const auto study =
        deck_of(test::two_blocks + fmt::format("checkpoint: {{at: [{}], last: false}}\n", at)).runs[0];
    ASSERT_EQ(run(study).status, Status::complete);
    EXPECT_EQ(results::read_checkpoint(folder_ / study.name / results::checkpoint_file).memento.state.t, kept)
        << at;
  }
}

} // namespace
} // namespace rubato::run::continued_run_test
