// SPDX-License-Identifier: LGPL-3.0-or-later
// What contact_<zone>.csv says, beside the resultants and the energy ledger.
#include "rubato/deck/read.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace rubato::results::contact_table_test {
namespace {

/// A line of a table whose cells are numbers, words or empty, by column.
using Line = std::map<std::string, std::string>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  for (const char letter : line)
    if (letter == ',')
      cells.emplace_back();
    else
      cells.back() += letter;
  return cells;
}

std::vector<Line> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string text;
  std::getline(file, text);
  const auto columns = cells_of(text);
  std::vector<Line> lines;
  while (std::getline(file, text)) {
    const auto cells = cells_of(text);
    EXPECT_EQ(cells.size(), columns.size()) << text;
    Line line;
    for (std::size_t i = 0; i < columns.size(); ++i)
      line[columns[i]] = cells.at(i);
    lines.push_back(line);
  }
  return lines;
}

double number(const Line& line, const std::string& column) {
  return std::stod(line.at(column));
}

struct Kind {
  const char* name;
  const std::string& deck;
  const char* zone;
  std::vector<deck::Setting> settings;
};

std::string name_of(const testing::TestParamInfo<Kind>& info) {
  return info.param.name;
}

/// A shrink fit of two rings, without friction.
const std::string rings = R"(
mesh:
  generate:
    - {name: shaft, rectangle: {from: [0, 0], to: [20, 20]}, divisions: [3, 4], cells: quad8, sides: {right: shaft_side, bottom: floor, left: axis}}
    - {name: ring, rectangle: {from: [19.95, 0], to: [30, 20]}, divisions: [3, 5], cells: quad8, sides: {left: ring_side, bottom: floor}}
physics: axisymmetric
materials: {steel: {young: 210000, poisson: 0.3}}
supports: [{on: floor, fix: [y]}, {on: axis, fix: [x]}]
contact: {fit: {master: shaft_side, slave: ring_side}}
time: {scheme: static, step: 1, end: 1}
)";

std::vector<Kind> kinds() {
  return {{"Hht", test::two_beams, "interface", {}},
          {"Mortar", test::two_beams, "interface", {{"contact.interface.integration", "mortar"}}},
          {"MoreauJean", test::two_beams, "interface", {{"time.scheme", "moreau_jean"}, {"time.alpha", "~"}}},
          {"NodalLagrange", test::two_beams, "interface", {{"contact.interface.method", "nodal_lagrange"}}},
          {"GaussPoints", test::two_beams, "interface", {{"contact.interface.integration", "{gauss: 2}"}}},
          {"Penalty", test::two_beams, "interface", {{"contact.interface.method", "penalty"}}},
          {"Static", test::block_on_plane, "foot", {{"supports.1.x.value", "1e-4"}}},
          {"Obstacle",
           test::block_on_obstacle,
           "foot",
           {{"mesh.generate.0.cells", "hexa20"}, {"time.step", "0.25"}}},
          {"AxisymmetricMortar", rings, "fit", {}},
          {"Explicit",
           test::two_beams,
           "interface",
           {{"time.scheme", "central_difference"},
            {"time.alpha", "~"},
            {"time.step", "auto"},
            {"time.record", "1e-3"},
            {"contact.interface.method", "penalty"}}}};
}

class ContactTables : public testing::TestWithParam<Kind> {};

TEST_P(ContactTables, AddUpToResultantsAndTheLedger) {
  const test::ScratchFolder folder;
  auto settings = GetParam().settings;
  settings.push_back({"fields", "{every: 1, formats: [vtu]}"});
  auto study = deck::parse_deck(GetParam().deck, "deck.yaml", settings).runs.front();
  ASSERT_EQ(run::run_study(study, folder.path(), {}).status, RunStatus::complete);
  const std::string zone = GetParam().zone;
  const auto resultants = read_csv(folder / ("resultants_" + zone + ".csv"));
  const auto energy = read_csv(folder / "energy.csv");
  std::map<double, double> normal;
  std::map<double, double> work;
  std::map<double, int> closed;
  for (const auto& line : lines_of(folder / ("contact_" + zone + ".csv"))) {
    const double t = number(line, "t");
    normal[t] += number(line, "pressure") * number(line, "area");
    work[t] += number(line, "friction_work");
    closed[t] += line.at("status") != "open" ? 1 : 0;
    EXPECT_EQ(line.at("gap").empty() && line.at("status") != "open", false) << t;
  }
  ASSERT_EQ(normal.size(), resultants.rows.size());
  const auto value = [](const Table& table, std::size_t row, const char* column) {
    return table.rows[row][static_cast<std::size_t>(table.column(column))];
  };
  double largest = 0;
  double most = 0;
  for (std::size_t i = 0; i < resultants.rows.size(); ++i)
    largest = std::max(largest, value(resultants, i, "normal"));
  for (std::size_t i = 0; i < energy.rows.size(); ++i)
    for (std::size_t j = 1; j + 1 < energy.columns.size(); ++j)
      most = std::max(most, std::abs(energy.rows[i][j]));
  EXPECT_GT(largest, 0);
  for (std::size_t i = 0; i < resultants.rows.size(); ++i) {
    const double t = resultants.rows[i][0];
    EXPECT_NEAR(normal.at(t), value(resultants, i, "normal"), 1e-12 * largest) << t;
    EXPECT_EQ(closed.at(t), value(resultants, i, "in_contact")) << t;
    EXPECT_NEAR(work.at(t), value(energy, i + 1, "friction"), 1e-12 * most) << t;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, ContactTables, testing::ValuesIn(kinds()), name_of);

TEST(ContactTable, FollowsTheSlaveFromItsStartAndNamesItsNodes) {
  const test::ScratchFolder folder;
  run::run_study(deck::parse_deck(test::two_blocks, "deck.yaml").runs.front(), folder.path(), {});
  const auto lines = lines_of(folder / "contact_interface.csv");
  ASSERT_EQ(lines.size(), 5U) << "the last instant alone";
  for (const auto& line : lines) {
    EXPECT_EQ(line.at("node").front(), 'N');
    EXPECT_NEAR(number(line, "s"), 1 - number(line, "x"), 2e-2) << "the body is on the left";
    EXPECT_EQ(line.count("z"), 0U);
  }
}

TEST(ContactTable, OfPointsBetweenTheNodesNamesNone) {
  const test::ScratchFolder folder;
  const std::vector<deck::Setting> gauss{{"contact.interface.integration", "{gauss: 3}"}};
  run::run_study(deck::parse_deck(test::two_blocks, "deck.yaml", gauss).runs.front(), folder.path(), {});
  const auto lines = lines_of(folder / "contact_interface.csv");
  ASSERT_EQ(lines.size(), 12U);
  std::vector<double> places;
  std::vector<double> expected;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].at("node"), "");
    places.push_back(number(lines[i], "s"));
    const double in_face = 0.5 * (1 + (static_cast<double>(i % 3) - 1) * std::sqrt(0.6));
    expected.push_back(0.25 * (static_cast<double>(i / 3) + in_face));
  }
  std::ranges::sort(places);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_NEAR(places[i], expected[i], 1e-12);
}

TEST(ContactTable, HasItsLastInstantWhereARunStopsEarly) {
  const test::ScratchFolder folder;
  int asked = 0;
  run::Watch watch;
  watch.stop = [&] { return ++asked > 40; };
  const auto result =
      run::run_study(deck::parse_deck(test::two_beams, "deck.yaml").runs.front(), folder.path(), watch);
  ASSERT_EQ(result.status, RunStatus::interrupted);
  const auto lines = lines_of(folder / "contact_interface.csv");
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(number(lines.front(), "t"), read_csv(folder / "probes.csv").rows.back().front());
}

} // namespace
} // namespace rubato::results::contact_table_test
