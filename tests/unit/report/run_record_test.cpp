// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/run_record.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>

namespace rubato::report::run_record_test {
namespace {

class RecordOfARun : public testing::Test {
protected:
  RecordOfARun() {
    write("run.json", R"({"run": "a", "status": "complete", "steps": 2, "tolerances": {"closed_gap": 1e-9},
      "warnings": ["energy gained"], "study": {"title": "t", "physics": "solid", "contact": {"joint": {}}}})");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  nlohmann::ordered_json record() const { return run_record(folder_.path()); }

  test::ScratchFolder folder_;
};

TEST_F(RecordOfARun, HasItsTablesByColumns) {
  write("probes.csv", "t,tip.x\n0,0.5\n1,0.25\n");
  write("resultants_joint.csv", "t,smallest_gap\n1,inf\n");
  write("resultants_more.csv", "t,normal\n1,2\n");
  const auto tables = record().at("tables");
  ASSERT_EQ(tables.size(), 3U);
  EXPECT_EQ(tables[0].at("kind"), "probes");
  EXPECT_EQ(tables[0].at("columns").dump(), R"(["t","tip.x"])");
  EXPECT_EQ(tables[0].at("values").dump(), "[[0.0,1.0],[0.5,0.25]]");
  EXPECT_EQ(tables[1].at("zone"), "joint");
  EXPECT_EQ(tables[1].at("values").dump(), "[[1.0],[null]]");
  EXPECT_EQ(tables[2].at("zone"), "more");
}

TEST_F(RecordOfARun, KeepsSummaryStudyAndTolerancesApart) {
  const auto found = record();
  EXPECT_EQ(found.at("summary").dump(), R"({"run":"a","status":"complete","steps":2})");
  EXPECT_EQ(found.at("study").at("title"), "t");
  EXPECT_EQ(found.at("tolerances").at("closed_gap"), 1e-9);
  EXPECT_EQ(found.at("warnings").dump(), R"(["energy gained"])");
}

TEST_F(RecordOfARun, HasItsAttemptsAndTheFailedOnesInFull) {
  write("steps.jsonl",
        R"({"begin":0.0,"end":1.0,"accepted":false,"iterations":9,"unmet":[{"criterion":"gap"}]})"
        "\n"
        R"({"begin":0.0,"end":0.5,"accepted":true,"iterations":3})"
        "\n"
        R"({"begin":0.5,"end":1.)");
  const auto attempts = record().at("attempts");
  EXPECT_EQ(attempts.at("count"), 2);
  EXPECT_EQ(attempts.at("iterations").dump(), "[9,3]");
  EXPECT_EQ(attempts.at("accepted").dump(), "[false,true]");
  EXPECT_EQ(attempts.at("residual").dump(), "[null,null]");
  ASSERT_EQ(attempts.at("failed").size(), 1U);
  EXPECT_EQ(attempts.at("failed")[0].at("unmet")[0].at("criterion"), "gap");
}

TEST_F(RecordOfARun, SaysWhatItCouldNotRead) {
  write("probes.csv", "t,tip.x\n0,0.5\n1,0.");
  write("energy.csv", "t,kinetic\n0,much\n");
  const auto found = record();
  EXPECT_EQ(found.at("tables").size(), 1U);
  ASSERT_EQ(found.at("warnings").size(), 2U);
  EXPECT_EQ(found.at("warnings")[1],
            fmt::format("energy.csv is not shown: {}:2:1: found 'much', expected a number",
                        (folder_ / "energy.csv").string()));
}

TEST_F(RecordOfARun, ThinsOutLongTables) {
  std::string text = "t,tip.x\n";
  for (int i = 0; i < 25000; ++i)
    text += fmt::format("{},{}\n", i, 2 * i);
  write("probes.csv", text);
  const auto found = record();
  const auto& values = found.at("tables")[0].at("values");
  EXPECT_LE(values[0].size(), 10001U);
  EXPECT_EQ(values[0].back(), 24999.0);
  EXPECT_EQ(values[1][1], 6.0);
  EXPECT_EQ(found.at("warnings")[1], "probes.csv has 25000 lines, of which the curves here show one in 3");
}

TEST_F(RecordOfARun, NeedsASummary) {
  write("run.json", R"({"run": "a"})");
  EXPECT_NE(test::fault_of([&] { record(); }).find("run.json: not the summary of a run"), std::string::npos);
  std::filesystem::remove(folder_ / "run.json");
  EXPECT_EQ(test::fault_of([&] { record(); }),
            (folder_ / "run.json").string() + ": cannot be read, expected the run.json of a run");
}

} // namespace
} // namespace rubato::report::run_record_test
