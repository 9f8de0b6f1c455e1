// SPDX-License-Identifier: LGPL-3.0-or-later
// kill -9 at any moment: what is resumed ends as what was never touched. RUBATO_KILLS: how often.
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "decks.hpp"
#include "same_results.hpp"
#include "support/scratch_folder.hpp"
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <thread>

namespace rubato::killed_test {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

int kills() {
  const char* wanted = std::getenv("RUBATO_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 6;
}

class KilledRun : public testing::TestWithParam<const std::string*> {
protected:
  KilledRun() {
    test::write_text(folder_ / "deck.yaml", *GetParam());
    const auto begin = Clock::now();
    EXPECT_EQ(test::run_program({"run", "deck.yaml", "-o", "whole", "-q"}, folder_.path()).exit_code, 0);
    length_ = Clock::now() - begin;
  }

  /// Lets the program work for a while; true when it came to its end by then.
  bool work_for(Seconds time, const std::vector<std::string>& arguments) const {
    test::Program program(arguments, folder_.path());
    std::this_thread::sleep_for(time);
    const bool done = !program.is_running();
    program.send(SIGKILL);
    program.wait();
    return done;
  }

  test::ScratchFolder folder_;
  Seconds length_{};
};

TEST_P(KilledRun, EndsAsOneThatWasNeverTouched) {
  std::mt19937 random(20240229);
  std::uniform_real_distribution<double> moment(0.05, 0.95);
  for (int i = 0; i < kills(); ++i) {
    std::filesystem::remove_all(folder_ / "out");
    const double killed_at = moment(random);
    work_for(killed_at * length_, {"run", "deck.yaml", "-o", "out", "-q"});
    const auto resumed = test::run_program({"run", "deck.yaml", "-o", "out", "--resume"}, folder_.path());
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
    test::expect_same_results(folder_ / "whole", folder_ / "out");
    ASSERT_FALSE(HasFailure()) << "killed after " << killed_at << " of its time\n" << resumed.err;
  }
}

/// Killed again and again while it resumes, each time a little later: sooner or later it must arrive.
TEST_P(KilledRun, SurvivesManyKillsOnItsWay) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> part(0.3, 0.8);
  bool done = work_for(0.3 * length_, {"run", "deck.yaml", "-o", "out", "-q"});
  for (int i = 0; i < 4 && !done; ++i)
    done = work_for(part(random) * length_, {"run", "deck.yaml", "-o", "out", "-q", "--resume"});
  const auto last = test::run_program({"run", "deck.yaml", "-o", "out", "-q", "--resume"}, folder_.path());
  ASSERT_EQ(last.exit_code, 0) << last.err;
  test::expect_same_results(folder_ / "whole", folder_ / "out");
}

INSTANTIATE_TEST_SUITE_P(Of, KilledRun, testing::Values(&test::rubbing_beams, &test::explicit_beams),
                         [](const auto& chosen) {
                           return chosen.param == &test::rubbing_beams ? "ImplicitSteps" : "ExplicitSteps";
                         });

} // namespace
} // namespace rubato::killed_test
