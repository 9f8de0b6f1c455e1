// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact by conjugate gradients moves bodies as the active set does.
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <set>
#include <string>
#include <vector>

namespace rubato::step::nodal_pcg_test {
namespace {

using Changes = std::vector<deck::Setting>;
using Eigen::VectorXd;
using test::Walk;

/// A cantilever of bricks that swings onto another one and back.
const std::string solid_beams = R"(
mesh:
  generate:
    - {name: upper, box: {from: [0, 0, 0], to: [1, 0.1, 0.2]}, divisions: [10, 2, 2], cells: hexa8,
       sides: {left: wall, bottom: contact}, edges: {right_top: loaded}}
    - {name: lower, box: {from: [0, -0.1, 0], to: [1, 0, 0.2]}, divisions: [13, 2, 3], cells: hexa8,
       sides: {left: wall, top: below}}
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
functions: {wave: {times: [0, 0.004, 0.008], values: [-1, 1, -1]}}
supports: [{on: wall, fix: [x, y, z]}]
loads: [{line_force: {on: loaded, y: 5e6, function: wave}}]
contact: {interface: {master: contact, slave: below, integration: nodes, exclude_nodes: [wall]}}
time: {scheme: hht, alpha: -0.3, step: 4e-4, end: 0.008}
newton: {residual: 1e-12}
)";

/// A block pressed unevenly on a plane, let go and pressed again.
const std::string block_before_plane = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [6, 4], sides: {top: top, bottom: under}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
functions: {wave: {times: [0, 0.3, 0.6, 1], values: [0, 1, -1, 1]}}
supports: [{on: top, x: 0, y: {value: -0.02, function: wave}}]
contact:
  foot: {slave: under, integration: nodes, obstacle: {plane: {point: [0, 0], normal: [0.03, 1]}}}
time: {scheme: hht, alpha: -0.3, step: 0.05, end: 1}
newton: {residual: 1e-12}
)";

/// Every step of a walk.
struct Course {
  std::vector<VectorXd> motions, forces;
  std::set<int> in_contact; ///< how many points were, in some step
  int iterations = 0;
};

Course course_of(const std::string& deck, Changes changes) {
  Walk walk(deck, changes);
  Course course;
  walk.accepted = [&] {
    course.motions.push_back(walk.state().motion.u);
    course.forces.push_back(walk.state().contact_force);
    course.in_contact.insert(points_in_contact(walk.state()));
  };
  EXPECT_TRUE(walk.to_end());
  course.iterations = walk.simulation.counters().iterations;
  return course;
}

void expect_near(const std::vector<VectorXd>& found, const std::vector<VectorXd>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  double largest = 0;
  for (const auto& values : expected)
    largest = std::max(largest, values.lpNorm<Eigen::Infinity>());
  ASSERT_GT(largest, 0);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LE((found[i] - expected[i]).lpNorm<Eigen::Infinity>(), 1e-10 * largest) << "step " << i;
}

struct Bodies {
  const char* name;
  std::string deck;
  std::string zone;
  Changes changes;
};
void PrintTo(const Bodies& bodies, std::ostream* out) {
  *out << bodies.name;
}

class NodalPcg : public testing::TestWithParam<Bodies> {
protected:
  static Course by(const std::string& method) {
    auto changes = GetParam().changes;
    const auto zone = "contact." + GetParam().zone;
    changes.push_back({zone + ".method", method});
    changes.push_back({zone + ".friction", "0"});
    changes.push_back({zone + ".iterate", "{geometry: {by: fixed_point, tolerance: 1e-10, max_loops: 50}}"});
    return course_of(GetParam().deck, changes);
  }
};

TEST_P(NodalPcg, GivesTheMotionAndForcesOfNodalLagrange) {
  const auto expected = by("nodal_lagrange");
  const auto found = by("nodal_pcg");
  EXPECT_GT(expected.in_contact.size(), 2u) << "points open and close";
  expect_near(found.motions, expected.motions);
  expect_near(found.forces, expected.forces);
  EXPECT_EQ(found.in_contact, expected.in_contact);
  EXPECT_LE(found.iterations, expected.iterations);
}

INSTANTIATE_TEST_SUITE_P(Of, NodalPcg,
                         testing::Values(Bodies{"Beams",
                                                test::two_beams,
                                                "interface",
                                                {{"newton.residual", "1e-12"}, {"time.end", "0.03"}}},
                                         Bodies{"SolidBeams", solid_beams, "interface", {}},
                                         Bodies{"BlockBeforePlane", block_before_plane, "foot", {}}),
                         [](const auto& chosen) { return std::string(chosen.param.name); });

TEST(NodalPcgOfBeams, MovesThemAsTheActiveSetDoes) {
  const auto walk = [](const char* method) {
    Walk one(test::two_beams, {{"contact.interface.method", method}, {"contact.interface.friction", "0"}});
    EXPECT_TRUE(one.to_end()) << method;
    return one;
  };
  const auto exact = walk("nodal_lagrange");
  const auto gradients = walk("nodal_pcg");
  EXPECT_GT(exact.resultants().in_contact, 0);
  EXPECT_LT((exact.state().motion.u - gradients.state().motion.u).lpNorm<Eigen::Infinity>(),
            1e-8 * exact.state().motion.u.lpNorm<Eigen::Infinity>());
}

/// Conjugate gradients have found the points that touch: Newton's iteration changes none of them.
TEST(NodalPcgOfBeams, TakesOneIterationARoundOfTheGeometry) {
  Walk walk(test::two_beams,
            {{"contact.interface.method", "nodal_pcg"}, {"contact.interface.friction", "0"}});
  EXPECT_TRUE(walk.to_end());
  int rounds = 0;
  for (const auto& report : walk.reports)
    for (const auto& round : report.rounds) {
      EXPECT_EQ(round.iterations, 1);
      ++rounds;
    }
  EXPECT_GE(rounds, 24) << "two a step at least";
}

} // namespace
} // namespace rubato::step::nodal_pcg_test
