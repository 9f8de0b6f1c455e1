// SPDX-License-Identifier: LGPL-3.0-or-later
/// Exact contact on every slave face: quadratic ones, whose points share multipliers, converge as others do.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::every_face_test {
namespace {

using test::Walk;

/// SDNL140 C: two clamped beams, the upper one struck at its tip.
const std::string beams = R"(
mesh:
  generate:
    - {name: upper, box: {from: [0, 0, 0], to: [1, 0.1, 0.1]}, divisions: [20, 2, 1],
       sides: {left: clamp, bottom: upper_face}, edges: {right_top: struck}}
    - {name: lower, box: {from: [0, -0.1, 0], to: [1, 0, 0.1]}, divisions: [20, 2, 1],
       sides: {left: clamp, top: lower_face}}
physics: solid
materials: {steel: {young: 200e9, poisson: 0, density: 7800}}
supports: [{on: clamp, fix: [x, y, z]}]
loads: [{line_force: {on: struck, y: -1e7}}]
contact: {interface: {master: upper_face, slave: lower_face, integration: nodes, friction: 0.2, exclude_nodes: [clamp]}}
time: {step: 1e-3, end: 0.012}
)";

struct Cells {
  const char* name;
  int most_iterations; ///< of twelve steps
};

int iterations_of(const Walk& walk) {
  int sum = 0;
  for (const auto& report : walk.reports)
    sum += report.iterations;
  return sum;
}

/// Of points in contact, in edges of the master.
double largest_overlap(const Walk& walk) {
  double largest = 0;
  const auto& zone = walk.state().zones.front();
  for (std::size_t i = 0; i < zone.status.size(); ++i)
    if (zone.status[i] != contact::Status::open)
      largest = std::max(largest, std::abs(zone.outcomes[i].gap));
  return largest / walk.model.zones.front().edge();
}

class BeamsOf : public testing::TestWithParam<Cells> {
protected:
  static std::vector<deck::Setting> changes() {
    return {{"mesh.generate.0.cells", GetParam().name}, {"mesh.generate.1.cells", GetParam().name}};
  }
  static void run(Walk& walk) {
    ASSERT_TRUE(walk.to_end());
    EXPECT_EQ(walk.reports.size(), 12u) << "a step was cut";
    EXPECT_LE(iterations_of(walk), GetParam().most_iterations);
  }
};

TEST_P(BeamsOf, RubWithoutACutByHht) {
  auto all = changes();
  all.push_back({"time.scheme", "hht"});
  all.push_back({"time.alpha", "-0.3"});
  all.push_back({"time.start", "at_rest_unloaded"});
  Walk walk(beams, all);
  run(walk);
  if (walk.model.zones.front().points_own_multipliers) {
    EXPECT_LE(largest_overlap(walk), 1e-9);
  }
}

TEST_P(BeamsOf, RubWithoutACutByDefault) {
  Walk walk(beams, changes());
  run(walk);
}

INSTANTIATE_TEST_SUITE_P(Every, BeamsOf,
                         testing::Values(Cells{"tetra4", 45}, Cells{"tetra10", 60}, Cells{"penta6", 45},
                                         Cells{"penta15", 60}, Cells{"hexa8", 45}, Cells{"hexa20", 60},
                                         Cells{"hexa27", 45}),
                         [](const auto& cells) { return std::string(cells.param.name); });

} // namespace
} // namespace rubato::step::every_face_test
