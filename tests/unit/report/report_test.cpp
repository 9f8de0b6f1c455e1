// SPDX-License-Identifier: LGPL-3.0-or-later
// The page as a file; what it shows is tested in a browser (tests/browser).
#include "rubato/mesh/io/med.hpp"
#include "rubato/report/report.hpp"
#include "rubato/results/med_fields.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "unit/mesh_io/one_cell.hpp"
#include <array>
#include <fstream>
#include <iterator>

namespace rubato::report::report_test {
namespace {

namespace fs = std::filesystem;

class Report : public testing::Test {
protected:
  void run(const std::string& name, bool with_fields) const {
    fs::create_directories(folder_ / name);
    std::ofstream(folder_ / (name + "/run.json"))
        << R"({"run": "a", "status": "complete", "study": {"title": "a < b </script>", "time": {"end": 2.5}}})";
    if (!with_fields)
      return;
    const auto mesh = test::one_cell(CellType::hexa8, 3);
    const std::vector<double> values(3 * mesh.points.size(), 0.5);
    mesh::write_med(folder_ / (name + "/fields.med"), mesh, "mesh");
    results::append_med_fields(folder_ / (name + "/fields.med"), "mesh", {1, 2.5},
                               std::array{results::NodalField{"displacement", 3, values, {}, ""}});
  }
  Written write(std::vector<fs::path> runs) const { return write_report(runs, folder_ / "report.html"); }
  std::string text() const {
    std::ifstream file(folder_ / "report.html", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  /// What the scripts find in rubato.data.
  nlohmann::json data() const {
    const std::string mark = "id=\"report-data\">";
    const auto page = text();
    const auto begin = page.find(mark) + mark.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }

  test::ScratchFolder folder_;
};

TEST_F(Report, HasTwoRunsWithArraysOfTheirOwn) {
  run("one", true);
  run("two", true);
  const auto written = write({folder_ / "one", folder_ / "two"});
  EXPECT_TRUE(written.notes.empty());
  EXPECT_EQ(written.bytes, fs::file_size(folder_ / "report.html"));
  const auto runs = data().at("runs");
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].at("prefix"), "r0");
  EXPECT_EQ(runs[1].at("view").at("drawn_nodes"), 8);
  const auto page = text();
  EXPECT_NE(page.find("id=\"r0f0i0\""), std::string::npos);
  EXPECT_NE(page.find("id=\"r1f0i0\""), std::string::npos);
}

TEST_F(Report, IsNotDisturbedByWhatADeckSays) {
  run("one", true);
  write({folder_ / "one"});
  EXPECT_EQ(data().at("runs")[0].at("study").at("title"), "a < b </script>");
  EXPECT_NE(text().find("<title>a &lt; b &lt;/script&gt;: a</title>"), std::string::npos);
}

TEST_F(Report, HasNoMarksLeftAndTheLicencesOfItsLibraries) {
  run("one", false);
  write({folder_ / "one"});
  const auto page = text();
  for (const auto* mark : {"@TITLE@", "@STYLES@", "@DATA@", "@SCRIPTS@"})
    EXPECT_EQ(page.find(mark), std::string::npos) << mark;
  EXPECT_NE(page.find("three.js authors"), std::string::npos);
  EXPECT_NE(page.find("Leon Sorokin"), std::string::npos);
  EXPECT_TRUE(page.ends_with("</html>\n"));
}

TEST_F(Report, OfARunWithoutFieldsSaysHowToGetThem) {
  run("one", false);
  const auto written = write({folder_ / "one"});
  ASSERT_EQ(written.notes.size(), 1U);
  EXPECT_NE(written.notes[0].find("'fields: {at: [2.5]}'"), std::string::npos);
  EXPECT_TRUE(data().at("runs")[0].at("view").is_null());
}

TEST_F(Report, OfARunWithDamagedFieldsSaysSo) {
  run("one", false);
  std::ofstream(folder_ / "one/fields.pvd") << "<VTKFile type=\"Collection\"><Collection>";
  write({folder_ / "one"});
  EXPECT_NE(data().at("runs")[0].at("no_view").get<std::string>().find("fields.pvd: found no valid XML"),
            std::string::npos);
}

TEST_F(Report, ThatCannotBeWrittenIsRefusedAndLeavesNothing) {
  run("one", true);
  const auto file = folder_ / "none/report.html";
  const std::array runs{folder_ / "one"};
  EXPECT_EQ(test::fault_of([&] { write_report(runs, file); }),
            file.string() + ": cannot be written: is there such a folder, and may you write into it?");
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

} // namespace
} // namespace rubato::report::report_test
