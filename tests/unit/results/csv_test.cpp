// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/csv.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace rubato::results::csv_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

const std::vector<std::string> columns{"t", "tip.x", "tip.y"};

void write(const std::filesystem::path& path, std::string_view text) {
  std::ofstream(path) << text;
}

TEST(CsvFile, GivesBackTheVeryBitsThatWereWritten) {
  const ScratchFolder folder;
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> rows{
      {0.1, -0.0, 1.0 / 3}, {5e-324, 1.7976931348623157e308, -inf}, {0.1 + 0.2, 1e22, 123456789.123456789}};
  std::mt19937_64 engine(1);
  for (int i = 0; i < 1000; ++i) {
    auto& row = rows.emplace_back();
    while (row.size() < columns.size())
      if (const auto value = std::bit_cast<double>(std::uint64_t{engine()}); std::isfinite(value))
        row.push_back(value);
  }
  {
    CsvWriter writer(folder / "a.csv", columns);
    for (const auto& row : rows)
      writer.row(row);
  }
  const auto table = read_csv(folder / "a.csv");
  EXPECT_EQ(table.columns, columns);
  ASSERT_EQ(table.rows.size(), rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(table.rows[r][c]), std::bit_cast<std::uint64_t>(rows[r][c]));
}

TEST(CsvFile, CanBeReadWhileItIsWritten) {
  const ScratchFolder folder;
  CsvWriter writer(folder / "a.csv", columns);
  EXPECT_TRUE(read_csv(folder / "a.csv").rows.empty());
  writer.row(std::array{1.0, 2.0, 3.0});
  EXPECT_EQ(read_csv(folder / "a.csv").rows.size(), 1U);
}

TEST(CsvFile, GoesOnWhereItStoodAndForgetsWhatCameAfter) {
  const ScratchFolder folder;
  std::uintmax_t bytes = 0;
  {
    CsvWriter writer(folder / "a.csv", columns);
    writer.row(std::array{1.0, 2.0, 3.0});
    bytes = writer.bytes();
    writer.row(std::array{4.0, 5.0, 6.0});
  }
  std::ofstream(folder / "a.csv", std::ios::app) << "7,8"; // a line that was being written
  CsvWriter writer(folder / "a.csv", bytes);
  EXPECT_EQ(writer.bytes(), bytes);
  writer.row(std::array{0.5, 0.0, 0.0});
  EXPECT_EQ(read_csv(folder / "a.csv").rows, (std::vector<std::vector<double>>{{1, 2, 3}, {0.5, 0, 0}}));
  EXPECT_EQ(writer.bytes(), std::filesystem::file_size(folder / "a.csv"));
}

TEST(CsvFile, DoesNotGoOnWhenItIsShorterThanItWas) {
  const ScratchFolder folder;
  write(folder / "a.csv", "t\n");
  EXPECT_EQ(fault_of([&] { CsvWriter(folder / "a.csv", 20); }),
            (folder / "a.csv").string() +
                ": found 2 bytes, expected the 20 bytes that the checkpoint counts on");
  EXPECT_THROW(CsvWriter(folder / "b.csv", 20), InputError);
}

TEST(CsvFile, FindsItsColumnsByName) {
  const Table table{columns, {}};
  EXPECT_EQ(table.column("tip.y"), 2);
  EXPECT_EQ(table.column("tip.z"), -1);
}

TEST(CsvFile, IsRefusedWithFileAndLineWhenItIsNoTable) {
  const ScratchFolder folder;
  const auto fault = [&](std::string_view text) {
    write(folder / "a.csv", text);
    return fault_of([&] { read_csv(folder / "a.csv"); });
  };
  const auto path = (folder / "a.csv").string();
  EXPECT_EQ(fault("t,x\n1,2\n3\n"), path + ":3:1: found 1 values, expected 2");
  EXPECT_EQ(fault("t,x\n1,two\n"), path + ":2:1: found 'two', expected a number");
  EXPECT_EQ(fault("t,x\n1,2 \n"), path + ":2:1: found '2 ', expected a number");
  EXPECT_NE(fault_of([&] { read_csv(folder / "none.csv"); }).find("cannot be read"), std::string::npos);
  EXPECT_NE(fault_of([&] { CsvWriter(folder / "no/a.csv", columns); }).find("cannot be written"),
            std::string::npos);
}

TEST(CsvLines, AreGivenAsTextWithTheirPlaces) {
  const ScratchFolder folder;
  std::ofstream(folder / "table.csv") << "t,node,gap\r\n1,N4,\n";
  std::vector<std::vector<std::string>> lines;
  read_csv_lines(folder / "table.csv", [&](std::span<const std::string_view> values, const Location& at) {
    EXPECT_EQ(at.line, static_cast<int>(lines.size()) + 1);
    lines.emplace_back(values.begin(), values.end());
  });
  EXPECT_EQ(lines, (std::vector<std::vector<std::string>>{{"t", "node", "gap"}, {"1", "N4", ""}}));
}

} // namespace
} // namespace rubato::results::csv_test
