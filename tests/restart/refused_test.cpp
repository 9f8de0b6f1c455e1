// SPDX-License-Identifier: LGPL-3.0-or-later
// Checkpoints that a run must not go on from: one sentence, exit code 2, nothing touched.
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "same_results.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <random>

namespace rubato::refused_test {
namespace {

using test::with;

class RefusedCheckpoint : public testing::Test {
protected:
  RefusedCheckpoint() {
    test::write_text(folder_ / "deck.yaml", deck_);
    EXPECT_EQ(test::run_program({"run", "deck.yaml", "-o", "out", "-q"}, folder_.path()).exit_code, 0);
    sound_ = test::text_of(file_);
  }

  /// What a resumed run says to the checkpoint as it is now.
  std::string sentence(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"run",      "deck.yaml", "-o",    "out",
                                       "--resume", "-q",        "--set", "time.end=6e-4"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto probes = test::text_of(folder_ / "out/run/probes.csv");
    const auto outcome = test::run_program(arguments, folder_.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_EQ(test::text_of(folder_ / "out/run/probes.csv"), probes);
    return outcome.err;
  }

  std::string sentence_for(const std::string& bytes) const {
    test::write_text(file_, bytes);
    return sentence();
  }

  test::ScratchFolder folder_;
  std::string deck_ = test::two_blocks;
  std::filesystem::path file_ = folder_ / "out/run/checkpoint.h5";
  std::string sound_;
};

constexpr auto start_over = "; without --resume the run starts over\n";

TEST_F(RefusedCheckpoint, ThatIsTruncated) {
  EXPECT_EQ(sentence_for(sound_.substr(0, sound_.size() - 1000)),
            "error: out/run/checkpoint.h5: the checkpoint is truncated: it has " +
                std::to_string(sound_.size() - 1000) + " of its " + std::to_string(sound_.size()) + " bytes" +
                start_over);
  EXPECT_EQ(sentence_for(""),
            std::string("error: out/run/checkpoint.h5: is no checkpoint of this program") + start_over);
  EXPECT_NE(sentence_for(sound_.substr(0, 600)).find("is truncated"), std::string::npos);
}

TEST_F(RefusedCheckpoint, WithAByteThatFlipped) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::size_t> place(0, sound_.size() - 1);
  for (int i = 0; i < 20; ++i) {
    auto bytes = sound_;
    bytes[place(random)] ^= 4;
    EXPECT_EQ(sentence_for(bytes),
              std::string("error: out/run/checkpoint.h5: the checkpoint is damaged: its checksum is not that "
                          "of its content") +
                  start_over);
  }
  for (const std::size_t in_head : {3UL, 26UL, 30UL, 45UL, 300UL}) {
    auto bytes = sound_;
    bytes[in_head] ^= 1;
    EXPECT_NE(sentence_for(bytes).find(start_over), std::string::npos) << in_head;
  }
}

TEST_F(RefusedCheckpoint, ThatIsSomethingElse) {
  EXPECT_NE(sentence_for("t,tip.x\n0,0\n").find("is no checkpoint of this program"), std::string::npos);
  EXPECT_NE(sentence_for(sound_.substr(512)).find("is no checkpoint of this program"), std::string::npos)
      << "HDF5 alone does not make a checkpoint";
}

TEST_F(RefusedCheckpoint, OfAnotherFormat) {
  EXPECT_EQ(
      sentence_for(with(sound_, "format 7\n", "format 6\n")),
      std::string("error: out/run/checkpoint.h5: the checkpoint has format 6, this program reads format 7") +
          start_over);
}

TEST_F(RefusedCheckpoint, OfAnotherDeck) {
  const auto because = [](const std::string& reason) {
    return "error: out/run/checkpoint.h5: the checkpoint is of another run: " + reason + start_over;
  };
  EXPECT_EQ(sentence({"--set", "contact.interface.friction=0.3"}),
            because("contact.interface.friction was 0.2 and is 0.3 now"));
  EXPECT_EQ(sentence({"--set", "time.step=5e-5"}), because("time.step was 0.0001 and is 5e-05 now"));
  EXPECT_EQ(sentence({"--set", "probes.end.field=velocity"}),
            because("probes.end.field was \"displacement\" and is \"velocity\" now"));
}

TEST_F(RefusedCheckpoint, ThatIsBeyondTheEnd) {
  EXPECT_EQ(
      sentence({"--set", "time.end=2e-4"}),
      "error: --set time.end: time.end: found 0.0002, but the checkpoint stands at t = 0.0004 already\n");
}

TEST_F(RefusedCheckpoint, WhoseTablesWereShortened) {
  test::write_text(folder_ / "out/run/probes.csv", "t\n");
  EXPECT_NE(sentence().find("out/run/probes.csv: found 2 bytes, expected the "), std::string::npos);
}

TEST(CheckpointOfAnotherMesh, IsRefused) {
  const test::ScratchFolder folder;
  const auto rest = test::two_blocks.substr(test::two_blocks.find("physics:"));
  test::write_text(folder / "mesh.yaml", test::two_blocks);
  ASSERT_EQ(test::run_program({"mesh", "mesh.yaml", "beams.med"}, folder.path()).exit_code, 0);
  test::write_text(folder / "deck.yaml", "mesh: {file: beams.med}\n" + rest);
  ASSERT_EQ(test::run_program({"run", "deck.yaml", "-o", "out", "-q"}, folder.path()).exit_code, 0);
  ASSERT_EQ(test::run_program({"mesh", "mesh.yaml", "beams.med", "--refine", "2"}, folder.path()).exit_code,
            0);
  const auto outcome = test::run_program({"run", "deck.yaml", "-o", "out", "-q", "--resume"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            std::string("error: out/run/checkpoint.h5: the checkpoint is of another run: its mesh "
                        "had other nodes, cells or groups") +
                start_over);
}

} // namespace
} // namespace rubato::refused_test
