// SPDX-License-Identifier: LGPL-3.0-or-later
// Force and moment in cuts of a cantilever, as probes of a run show them.
#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/scratch_folder.hpp"
#include <cmath>
#include <map>
#include <string>

namespace rubato::model::probe_cuts_test {
namespace {

/// 500 N along the beam, −1000 N across it, at the upper corner of its end.
const std::string cantilever = R"(
mesh:
  generate:
    - {name: beam, rectangle: {from: [0, 0], to: [1, 0.1]}, divisions: [10, 3], cells: quad8,
       sides: {left: root, right: end}, points: {right_top: tip}}
physics: plane_stress
thickness: 0.3
materials: {steel: {young: 200e9, poisson: 0.3}}
supports: [{on: root, fix: [x, y]}]
loads: [{nodal_force: {on: tip, x: 500, y: -1000}}]
time: {scheme: static, step: 1, end: 1}
probes:
  held: {on: root, field: reaction}
  middle: {section: {point: [0.5, 0.05], normal: [2, 0]}}
  between: {section: {point: [0.43, 0.05], normal: [1, 0], cells: beam}}
  other_side: {section: {point: [0.5, 0.05], normal: [-1, 0]}}
  border: {section: {on: root, point: [0, 0.05], normal: [-1, 0]}}
  oblique: {section: {point: [0.5, 0.05], normal: [1, 1]}}
  both: {minus: [middle, oblique]}
)";

const std::string block = R"(
mesh:
  generate:
    - {name: bar, box: {from: [0, 0, 0], to: [2, 0.4, 0.2]}, divisions: [8, 2, 2], cells: hexa8,
       sides: {left: root, right: end}, points: {right_top_front: tip}}
physics: solid
materials: {steel: {young: 1e6, poisson: 0.3}}
supports: [{on: root, fix: [x, y, z]}]
loads: [{nodal_force: {on: tip, x: 3, y: 5, z: -7}}]
time: {scheme: static, step: 1, end: 1}
probes: {cut: {section: {point: [1, 0.2, 0.1], normal: [1, 0, 0]}}}
)";

std::map<std::string, double> last_of(const std::string& deck) {
  const test::ScratchFolder folder;
  const auto study = deck::parse_deck(deck, "deck.yaml", {}).runs.front();
  EXPECT_EQ(run::run_study(study, folder.path(), {}).status, run::Status::complete);
  const auto table = results::read_csv(folder / "probes.csv");
  std::map<std::string, double> row;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    row[table.columns[c]] = table.rows.back()[c];
  return row;
}

/// Rounding of nodal forces, which are far larger than their sums.
constexpr double rounding = 1e-7;

TEST(CutsOfACantilever, BalanceTheLoadBehindThem) {
  const auto row = last_of(cantilever);
  const auto expect = [&](const std::string& cut, double x, double y, double moment) {
    EXPECT_NEAR(row.at(cut + ".x"), x, rounding) << cut;
    EXPECT_NEAR(row.at(cut + ".y"), y, rounding) << cut;
    EXPECT_NEAR(row.at(cut + ".mz"), moment, rounding) << cut;
  };
  expect("middle", 500, -1000, -1000 * 0.5 - 500 * 0.05);
  expect("between", 500, -1000, -1000 * 0.57 - 500 * 0.05);
  expect("other_side", -500, 1000, 1000 * 0.5 + 500 * 0.05);
  expect("border", -500, 1000, 1000 * 1 + 500 * 0.05);
  expect("oblique", 500, -1000, -1000 * 0.5 - 500 * 0.05);
  expect("both", 0, 0, 0);
  EXPECT_NEAR(row.at("held.x"), -500, rounding);
  EXPECT_NEAR(row.at("held.y"), 1000, rounding);
}

TEST(CutsOfACantilever, TellTensionFromShear) {
  const auto row = last_of(cantilever);
  EXPECT_NEAR(row.at("middle.normal"), 500, rounding);
  EXPECT_NEAR(row.at("middle.shear"), 1000, rounding);
  EXPECT_NEAR(row.at("other_side.normal"), 500, rounding) << "tension from both sides";
  EXPECT_NEAR(row.at("oblique.normal"), -500 / std::sqrt(2), rounding);
  EXPECT_NEAR(row.at("oblique.shear"), 1500 / std::sqrt(2), rounding);
}

TEST(CutsOfABar, HaveMomentsAboutThreeAxes) {
  const auto row = last_of(block);
  const Eigen::Vector3d force(3, 5, -7);
  const Eigen::Vector3d moment = Eigen::Vector3d(1, 0.2, 0.1).cross(force);
  const std::array<const char*, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(row.at(std::string("cut.") + axes[i]), force[static_cast<Eigen::Index>(i)], rounding);
    EXPECT_NEAR(row.at(std::string("cut.m") + axes[i]), moment[static_cast<Eigen::Index>(i)], rounding);
  }
  EXPECT_NEAR(row.at("cut.normal"), 3, rounding);
  EXPECT_NEAR(row.at("cut.shear"), std::sqrt(25 + 49), rounding);
}

TEST(CutsOfACantilever, AreRefusedWhereTheyCutNothing) {
  const auto fault = [](const std::string& section) {
    return test::fault_of([&] { test::model_of(cantilever, {{"probes.middle.section", section}}); });
  };
  EXPECT_NE(fault("{point: [2, 0], normal: [1, 0]}").find("the plane cuts nothing"), std::string::npos);
  EXPECT_NE(fault("{on: root, point: [0, 0], normal: [1, 0]}")
                .find("no cell behind the plane has a node of group 'root'"),
            std::string::npos);
  EXPECT_NE(fault("{point: [0.5, 0], normal: [1, 0], cells: baem}").find("did you mean 'beam'"),
            std::string::npos);
  EXPECT_NE(fault("{on: rot, point: [0, 0], normal: [-1, 0]}").find("did you mean 'root'"),
            std::string::npos);
  EXPECT_NE(fault("{point: [0.5, 0], normal: [1, 0], cells: root}").find("holds no cells that deform"),
            std::string::npos);
}

} // namespace
} // namespace rubato::model::probe_cuts_test
