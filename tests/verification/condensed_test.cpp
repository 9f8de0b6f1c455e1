// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whole runs of SDNL140 solved on the contact points alone must be what the whole system gives.
#include <gtest/gtest.h>

#include "verification/modelings.hpp"
#include "verification/sdnl140.hpp"

namespace rubato::verification::condensed_test {
namespace {

struct Whole {
  char letter;
  const char* run;
  const char* instants = nullptr; ///< instead of even steps
};

void PrintTo(const Whole& run, std::ostream* out) {
  *out << run.letter << '_' << run.run << (run.instants ? "_cut" : "");
}

class WholeRun : public testing::TestWithParam<Whole> {
protected:
  static Finished solved(const char* solver) {
    const auto& run = GetParam();
    std::vector<deck::Setting> changes{{"solver", solver}, {"newton.residual", "1e-12"}, {"fields", "~"}};
    if (run.instants)
      changes.insert(changes.end(), {{"time.step", "~"}, {"time.end", "~"}, {"time.instants", run.instants}});
    return finish(study_of(run.letter, run.run, changes));
  }
};

TEST_P(WholeRun, IsTheSameCondensedAndWhole) {
  const auto condensed = solved("condensed");
  const auto whole = solved("full");
  ASSERT_EQ(condensed.result.status, run::Status::complete) << condensed.result.message;
  ASSERT_EQ(whole.result.status, run::Status::complete) << whole.result.message;
  ASSERT_EQ(condensed.result.steps, whole.result.steps);
  EXPECT_LT(largest_difference(condensed, whole), 1e-10);
}

INSTANTIATE_TEST_SUITE_P(SDNL140, WholeRun,
                         testing::Values(Whole{'a', "evol1"}, Whole{'c', "evol1"}, Whole{'c', "evol2"},
                                         Whole{'c', "evol3"}, Whole{'c', "evol4"}, Whole{'d', "evol1"},
                                         Whole{'e', "evol1"}, Whole{'f', "evol1"}, Whole{'f', "evol2"},
                                         Whole{'f', "evol3"}, Whole{'f', "evol4"}, Whole{'f', "evol5"},
                                         Whole{'f', "evol1",
                                               "[0.001, 0.0015, 0.002, 0.003, 0.004, 0.00425, 0.0045, "
                                               "0.00475, 0.005, 0.006, 0.007, 0.008, 0.01, 0.012]"}),
                         [](const auto& run) {
                           return std::string(1, run.param.letter) + "_" + run.param.run +
                                  (run.param.instants ? "_cut" : "");
                         });

} // namespace
} // namespace rubato::verification::condensed_test
