// SPDX-License-Identifier: LGPL-3.0-or-later
// Two beams with mortar contact: random variants of them, and SDNL140 refined.
#include <gtest/gtest.h>

#include "verification/mortar_beams.hpp"
#include "verification/robustness.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::verification::mortar_beams_test {
namespace {

constexpr std::uint32_t seed = 140;
constexpr int count = 60;
constexpr int least = 25; ///< of them are light
/// Operators are held in an iteration's linearisation.
constexpr double iterations_of_nodes = 2.5;

struct Sweep {
  int finished = 0;
  int finished_by_nodes = 0;
  double steps = 0, iterations = 0;
  double steps_by_nodes = 0, iterations_by_nodes = 0;
};

void run_both(const Variant& variant, Sweep& sweep) {
  const auto mortar = survive(variant);
  const auto nodes = survive(by_nodes(variant));
  sweep.finished += mortar.finished() ? 1 : 0;
  sweep.finished_by_nodes += nodes.finished() ? 1 : 0;
  sweep.steps += mortar.result.steps;
  sweep.iterations += mortar.result.iterations;
  sweep.steps_by_nodes += nodes.result.steps;
  sweep.iterations_by_nodes += nodes.result.iterations;
  EXPECT_TRUE(mortar.finished()) << variant.number << ": " << variant.words << "\n" << mortar.failure;
  EXPECT_LE(mortar.balance, 1e-10) << variant.number << ": " << variant.words;
  if (variant.safe && !variant.overlaps) {
    EXPECT_FALSE(mortar.keeps_gain()) << variant.number << ": " << variant.words;
  }
}

/// Quadratic solids take most of a sweep's time: they are left to `make verify`.
bool is_light(const Variant& variant) {
  constexpr std::array heavy{"hexa20", "hexa27", "tetra10", "penta15"};
  return std::ranges::none_of(
      heavy, [&](const char* cells) { return variant.words.find(cells) != std::string::npos; });
}

TEST(RandomMortarBeams, AreThoseOfNodesButForTheIntegration) {
  const auto variant = variants(seed, 3, 1, Meshes::coarse, Integration::mortar).front();
  const auto nodes = by_nodes(variant);
  EXPECT_NE(variant.deck.find("integration: mortar"), std::string::npos);
  EXPECT_EQ(nodes.deck.find("mortar"), std::string::npos);
  EXPECT_NE(nodes.deck.find("integration: nodes"), std::string::npos);
  EXPECT_EQ(variant.deck.size(), nodes.deck.size() + 1);
}

TEST(RandomMortarBeams, FinishWithClosedLedgersInAboutTheIterationsOfNodes) {
  Sweep sweep;
  int run = 0;
  for (const auto& variant : variants(seed, 0, count, Meshes::coarse, Integration::mortar))
    if (is_light(variant)) {
      run_both(variant, sweep);
      ++run;
    }
  EXPECT_GE(run, least);
  EXPECT_GE(sweep.finished, sweep.finished_by_nodes);
  EXPECT_LE(sweep.iterations / sweep.steps,
            iterations_of_nodes * sweep.iterations_by_nodes / sweep.steps_by_nodes);
}

/// Relative error at 6 ms.
double error_of(const RefinedBeams& beams) {
  return std::abs(deflect(beams).y[1] / converged_deflections[1] - 1);
}

/// The limit is known to half of its last digit.
constexpr double known_to = 0.5e-4 / 0.1855;

TEST(RefinedBeams, ConvergeWithMortarAsFastAsWithNodes) {
  for (const bool matching : {true, false}) {
    double last = 1;
    for (const int k : {1, 2, 4}) {
      const double mortar = error_of({.fineness = k, .matching = matching});
      const double nodes = error_of({.fineness = k, .matching = matching, .integration = "nodes"});
      EXPECT_LE(mortar, nodes * 1.02 + known_to) << k;
      EXPECT_LE(mortar, last / 3) << k;
      last = mortar;
    }
  }
}

TEST(RefinedBeams, ReachTheConvergedAnswerWithMortar) {
  for (const bool matching : {true, false}) {
    const auto found = deflect({.cells = CellType::quad9, .fineness = 2, .matching = matching});
    for (std::size_t i = 0; i < found.y.size(); ++i)
      EXPECT_NEAR(found.y[i], converged_deflections[i], 2e-4) << i;
    EXPECT_EQ(found.cuts, 0);
  }
}

/// Segments are projected along the normals of nodes in the plane, of sub-facets in space: the two
/// discretisations differ by far less than either does from the limit (a tenth of it on these meshes).
TEST(RefinedBeams, AreAlikeInSpaceAndInThePlane) {
  const double peak = std::abs(converged_deflections[1]);
  const auto solid = deflect({.modeling = "c", .cells = CellType::hexa8});
  const auto plane = deflect({});
  for (std::size_t i = 0; i < solid.y.size(); ++i)
    EXPECT_NEAR(solid.y[i], plane.y[i], 1e-4 * peak) << i;
}

} // namespace
} // namespace rubato::verification::mortar_beams_test
