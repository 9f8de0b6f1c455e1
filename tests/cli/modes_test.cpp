// SPDX-License-Identifier: LGPL-3.0-or-later
// `rubato modes`: what it prints and writes, and what it refuses.
#include "rubato/results/csv.hpp"

#include <gtest/gtest.h>

#include "program.hpp"
#include "support/two_blocks.hpp"

namespace rubato::modes_test {
namespace {

class ModesCommand : public testing::Test {
protected:
  test::Outcome modes(const std::string& deck, const std::vector<std::string>& options = {}) const {
    test::write_text(folder_ / "deck.yaml", deck);
    std::vector<std::string> arguments{"modes", "deck.yaml"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return test::run_program(arguments, folder_.path());
  }

  std::vector<double> frequencies(const std::string& run) const {
    const auto table = results::read_csv(folder_ / run / "modes.csv");
    const auto column = static_cast<std::size_t>(table.column("frequency"));
    std::vector<double> values;
    for (const auto& row : table.rows)
      values.push_back(row[column]);
    return values;
  }

  test::ScratchFolder folder_;
};

TEST_F(ModesCommand, WritesATableAndShapes) {
  const auto outcome = modes(test::two_blocks, {"--number", "4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("run: 4 modes of 48 unknowns; modes.csv and modes.vtu in deck/run\n"))
      << outcome.out;
  EXPECT_NE(outcome.out.find("frequency [1/time]"), std::string::npos);
  const auto table = results::read_csv(folder_ / "deck/run/modes.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"mode", "frequency", "generalised_mass",
                                                     "effective_mass_x", "effective_mass_y", "residual"}));
  EXPECT_EQ(table.rows.size(), 4U);
  EXPECT_NE(test::text_of(folder_ / "deck/run/modes.vtu").find("Name=\"mode_4\""), std::string::npos);
}

TEST_F(ModesCommand, ClosesContact) {
  ASSERT_EQ(modes(test::two_blocks, {"-o", "open"}).exit_code, 0);
  const auto outcome = modes(test::two_blocks, {"--contact", "stuck", "-o", "stuck"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("contact.interface: 4 of 5 points touch and are held together"),
            std::string::npos)
      << outcome.out;
  EXPECT_GT(frequencies("stuck/run")[0], 1.2 * frequencies("open/run")[0]);
}

TEST_F(ModesCommand, WarnsOfFrictionThatIsLeftOut) {
  const auto said = [&](const char* friction, const char* contact) {
    const auto outcome =
        modes(test::two_blocks,
              {"--set", std::string("contact.interface.friction=") + friction, "--contact", contact});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err;
  };
  EXPECT_NE(said("0.2", "sliding")
                .find("warning: run: contact.interface: points slide without friction; with the "
                      "friction of the study motions may grow by themselves (squeal)"),
            std::string::npos);
  EXPECT_EQ(said("0.2", "stuck"), "");
  EXPECT_EQ(said("0.2", "open"), "");
  EXPECT_EQ(said("0", "sliding"), "");
}

TEST_F(ModesCommand, TakesTheFirstRunOrThoseOfOnly) {
  const auto deck = test::two_blocks + "runs:\n  a: {}\n  soft: {materials: {steel: {young: 50e9}}}\n";
  ASSERT_EQ(modes(deck).exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "deck/soft"));
  ASSERT_EQ(modes(deck, {"--only", "soft"}).exit_code, 0);
  EXPECT_NEAR(frequencies("deck/soft")[0], frequencies("deck/a")[0] / 2, 1e-6);
}

TEST_F(ModesCommand, LeavesTheResultsOfARunAlone) {
  ASSERT_EQ(test::run_program({"run", "deck.yaml", "-q"}, folder_.path()).exit_code, 2) << "no deck yet";
  test::write_text(folder_ / "deck.yaml", test::two_blocks);
  ASSERT_EQ(test::run_program({"run", "deck.yaml", "-q"}, folder_.path()).exit_code, 0);
  const auto before = test::text_of(folder_ / "deck/run/run.json");
  ASSERT_EQ(modes(test::two_blocks).exit_code, 0);
  EXPECT_EQ(test::text_of(folder_ / "deck/run/run.json"), before);
}

TEST_F(ModesCommand, RefusesBadInputWithItsPlace) {
  const auto statics = test::with(test::two_blocks, "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}",
                                  "{scheme: static, step: 1, end: 1}");
  const auto without_density = modes(test::with(statics, ", density: 7800", ""));
  EXPECT_EQ(without_density.exit_code, 2);
  EXPECT_NE(without_density.err.find("deck.yaml:16:3: 'density' is missing: vibrations move masses"),
            std::string::npos)
      << without_density.err;
  EXPECT_NE(modes(test::two_blocks, {"--number", "0"}).err.find("--number: found 0, expected 1 or more"),
            std::string::npos);
  const auto word = modes(test::two_blocks, {"--contact", "glued"});
  EXPECT_EQ(word.exit_code, 2);
  EXPECT_NE(word.err.find("--contact: found 'glued', expected open, stuck or sliding"), std::string::npos)
      << word.err;
  const auto group =
      modes(test::with(test::two_blocks, "{on: held, fix: [x, y]}", "{on: hold, fix: [x, y]}"));
  EXPECT_EQ(group.exit_code, 2);
  EXPECT_NE(group.err.find("deck.yaml:18:10: found 'hold', expected a group"), std::string::npos)
      << group.err;
}

} // namespace
} // namespace rubato::modes_test
