// SPDX-License-Identifier: LGPL-3.0-or-later
// Coefficients of friction that depend on the place, through the program.
#include <gtest/gtest.h>

#include "program.hpp"
#include "support/two_blocks.hpp"
#include <cmath>
#include <map>
#include <sstream>

namespace rubato::friction_test {
namespace {

using test::run_program;
using test::with;

/// A block that is pressed on a plane and dragged over it.
const std::string dragged =
    R"(mesh: {generate: [{name: b, rectangle: {from: [0, 0], to: [1, 0.2]}, divisions: [10, 2], sides: {bottom: under, top: roof}}]}
physics: plane_strain
materials: {steel: {young: 200e9, poisson: 0.3}}
supports: [{on: roof, y: -1e-5, x: {value: 1e-2, function: pull}}]
functions: {pull: {ramp: [0, 1]}}
contact: {floor: {slave: under, obstacle: {plane: {point: [0, 0], normal: [0, 1]}}, friction: "0.1+0.2*x"}}
time: {scheme: static, step: 0.5, end: 1}
)";

class FrictionOfPlace : public testing::Test {
protected:
  void run(const std::string& deck, const std::string& output) const {
    test::write_text(folder_ / "deck.yaml", deck);
    const auto outcome = run_program({"run", "deck.yaml", "-o", output, "-q"}, folder_.path());
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  std::string refusal(const std::string& deck) const {
    test::write_text(folder_ / "deck.yaml", deck);
    const auto outcome = run_program({"run", "deck.yaml", "-o", "bad", "-q"}, folder_.path());
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  }

  test::ScratchFolder folder_;
};

/// Rows of a table of the results, by the names of their columns.
std::vector<std::map<std::string, double>> rows_of(const std::string& text) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');)
      cells.push_back(cell);
    return cells;
  };
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  const auto names = cells_of(line);
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(stream, line)) {
    const auto cells = cells_of(line);
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < cells.size(); ++i)
      row[names[i]] = std::atof(cells[i].c_str());
  }
  return rows;
}

TEST_F(FrictionOfPlace, IsThatOfEachPoint) {
  for (const auto& deck :
       {dragged, with(dragged, "\"0.1+0.2*x\"", "{along: x, at: [0, 1], values: [0.1, 0.3]}"),
        with(dragged, "\"0.1+0.2*x\"", "\"0.1+0.2*x\", method: penalty, friction_method: penalty"),
        with(dragged, "\"0.1+0.2*x\"", "\"0.1+0.2*x\", integration: {gauss: 2}")}) {
    run(deck, "out");
    const auto points = rows_of(test::text_of(folder_ / "out/run/contact_floor.csv"));
    ASSERT_GE(points.size(), 10U);
    for (const auto& point : points) {
      // The block has come 0.01 from where the coefficients were found.
      const double friction = 0.1 + 0.2 * (point.at("x") - 0.01);
      EXPECT_NEAR(std::abs(point.at("traction.x")) / point.at("pressure"), friction, 1e-5)
          << deck << point.at("x");
    }
  }
}

TEST_F(FrictionOfPlace, IsTheSameAsANumberWhereItIsOne) {
  const auto explicitly =
      with(with(test::two_blocks, "scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4",
                "scheme: central_difference, step: auto, record: 1e-4, end: 4e-4"),
           "integration: nodes", "integration: nodes, method: penalty, friction_method: penalty");
  for (const auto& deck :
       {test::two_blocks, with(test::two_blocks, "integration: nodes", "integration: mortar"), explicitly}) {
    run(deck, "number");
    run(with(deck, "friction: 0.2", "friction: 0.2+0*x"), "expression");
    EXPECT_EQ(test::text_of(folder_ / "number/run/probes.csv"),
              test::text_of(folder_ / "expression/run/probes.csv"));
  }
}

TEST_F(FrictionOfPlace, IsRefusedWhereItIsNegativeOrChangesWithTime) {
  EXPECT_EQ(refusal(with(dragged, "\"0.1+0.2*x\"", "0.5-x")),
            "error: deck.yaml:6:95: contact.floor.friction: found -0.1 at x = 0.6, y = 0, z = 0, t = 0, "
            "expected a "
            "number >= 0\n");
  EXPECT_EQ(refusal(with(dragged, "\"0.1+0.2*x\"", "x*t")),
            "error: deck.yaml:6:95: contact.floor.friction: found t in 'x*t', friction depends on the place "
            "only\n");
}

} // namespace
} // namespace rubato::friction_test
