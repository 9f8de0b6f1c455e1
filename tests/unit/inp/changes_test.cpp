// SPDX-License-Identifier: LGPL-3.0-or-later
// Changes of the model in later steps: friction, contact pairs, yield stresses, equations, the scheme.
#include "rubato/inp/read.hpp"

#include <gtest/gtest.h>

#include "computed.hpp"
#include "small_files.hpp"
#include "support/scratch_folder.hpp"
#include <algorithm>
#include <fstream>

namespace rubato::changes_test {
namespace {

constexpr double young = 1000;

/// Two cubes on top of each other that touch; the floor of the lower one and the lid of the upper one are
/// held.
const std::string blocks = "*NODE, NSET=ALL\n" + test::cube_nodes + R"( 11, 0, 0, 1
 12, 1, 0, 1
 13, 1, 1, 1
 14, 0, 1, 1
 15, 0, 0, 2
 16, 1, 0, 2
 17, 1, 1, 2
 18, 0, 1, 2
*ELEMENT, TYPE=C3D8, ELSET=E
 1, 1, 2, 3, 4, 5, 6, 7, 8
 2, 11, 12, 13, 14, 15, 16, 17, 18
*NSET, NSET=FLOOR
 1, 2, 3, 4
*NSET, NSET=LID
 15, 16, 17, 18
*SURFACE, NAME=UPPER
 2, S1
*SURFACE, NAME=LOWER
 1, S2
*MATERIAL, NAME=M
*ELASTIC
 1000., 0.
*DENSITY
 1.
*SOLID SECTION, ELSET=E, MATERIAL=M
*SURFACE INTERACTION, NAME=TOUCH
*FRICTION
 MU
*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE
 UPPER, LOWER
*BOUNDARY
 FLOOR, 1, 3
 LID, 1, 2
)";

std::string with_friction(const std::string& coefficient) {
  auto text = blocks;
  return text.replace(text.find("MU"), 2, coefficient);
}

std::string step(const std::string& lines) {
  return "*STEP\n*STATIC, DIRECT\n 0.5, 1.\n" + lines + "*END STEP\n";
}

test::Computed computed(const std::string& text) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "a.inp") << text;
  return test::Computed(inp::read_input(folder / "a.inp").runs);
}

/// Mean displacement of the nodes 5 to 8, the roof of the lower cube.
double roof(const test::Computed& runs, std::size_t run, int axis) {
  const auto model = runs.model(run);
  double sum = 0;
  for (int node = 4; node < 8; ++node)
    sum += runs.displacements(run)[model.dofs.dof(node, axis)];
  return sum / 4;
}

const std::string press = "*BOUNDARY\n LID, 3, 3, -0.002\n";

TEST(ChangesOfSteps, TakePairsAwayAndPutThemBack) {
  const auto runs = computed(with_friction("0.3") + step(press) +
                             step("*MODEL CHANGE, TYPE=CONTACT PAIR, REMOVE\n UPPER, LOWER\n") +
                             step("*MODEL CHANGE, TYPE=CONTACT PAIR, ADD\n UPPER, LOWER\n"));
  EXPECT_NEAR(roof(runs, 0, 2), -0.001, 1e-9);
  EXPECT_NEAR(roof(runs, 1, 2), 0, 1e-12);
  EXPECT_NEAR(roof(runs, 2, 2), -0.001, 1e-9);
}

TEST(ChangesOfSteps, TakeElementsAwayAndPutThemBack) {
  // Two cubes on top of each other, held in between; a force on the lower one.
  const auto two = [](const std::string& steps) {
    auto text = test::cube;
    text.replace(text.find("*ELEMENT"), 8,
                 " 9, 0, 0, 2\n 10, 1, 0, 2\n 11, 1, 1, 2\n 12, 0, 1, 2\n*ELEMENT, TYPE=C3D8R, ELSET=SECOND\n"
                 " 2, 5, 6, 7, 8, 9, 10, 11, 12\n*ELSET, ELSET=BOTH\n SECOND\n*ELEMENT");
    text.replace(text.find("ELSET=E, MATERIAL"), 7, "ELSET=BOTH");
    text.replace(text.find("*MATERIAL"), 9, "*ELSET, ELSET=BOTH\n E\n*MATERIAL");
    return computed(text + " 8, 1, 3\n" + steps);
  };
  const auto runs = two(step("*CLOAD\n 1, 3, 1.\n 2, 3, 1.\n 3, 3, 1.\n 4, 3, 1.\n") +
                        step("*MODEL CHANGE, TYPE=ELEMENT, REMOVE\n SECOND\n*BOUNDARY\n 9, 3, 3, 0.1\n") +
                        step("*MODEL CHANGE, TYPE=ELEMENT, ADD=WITH STRAIN\n SECOND\n"));
  const auto down = [&](std::size_t run) { return runs.displacement(run, {0, 0, 0}, 2); };
  EXPECT_GT(down(0), 0);
  EXPECT_NEAR(down(1), down(0), 1e-9 * down(0));
  EXPECT_NEAR(runs.displacement(1, {0, 0, 2}, 2), 0.1, 1e-15);
}

TEST(ChangesOfSteps, ChangeFriction) {
  const std::string drag = "*BOUNDARY\n LID, 1, 1, 0.01\n";
  const std::string more = "*CHANGE FRICTION, INTERACTION=TOUCH\n*FRICTION\n 0.3\n";
  const auto changed = computed(with_friction("0.") + step(press) + step(more + drag));
  const auto always = computed(with_friction("0.3") + step(press) + step(drag));
  EXPECT_NEAR(roof(changed, 0, 0), 0, 1e-12);
  EXPECT_GT(roof(always, 1, 0), 1e-5);
  EXPECT_NEAR(roof(changed, 1, 0), roof(always, 1, 0), 1e-8 * roof(always, 1, 0));
  // The changed friction stays in later steps.
  const auto input = inp::parse_input(with_friction("0.1") + step(press) + step(more) + step(""), "a.inp");
  EXPECT_EQ(input.runs[0].contact[0].friction, 0.1);
  EXPECT_EQ(input.runs[1].contact[0].friction, 0.3);
  EXPECT_EQ(input.runs[2].contact[0].friction, 0.3);
}

TEST(ChangesOfSteps, ChangeThePressureOverClosure) {
  const auto input = inp::parse_input(with_friction("0.1") + step(press) +
                                          step("*CHANGE SURFACE BEHAVIOR, INTERACTION=TOUCH\n*SURFACE "
                                               "BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n 1.E6\n"),
                                      "a.inp");
  EXPECT_EQ(input.runs[0].contact[0].method, study::ContactMethod::augmented_lagrangian);
  EXPECT_EQ(input.runs[1].contact[0].method, study::ContactMethod::penalty);
  EXPECT_EQ(input.runs[1].contact[0].normal_coefficient, 1e6);
}

TEST(ChangesOfSteps, ChangeYieldStresses) {
  auto text = with_friction("0.");
  text.replace(text.find("*DENSITY"), 8, "*PLASTIC\n 5., 0.\n 10., 0.1\n*DENSITY");
  const auto input = inp::parse_input(
      text + step(press) + step("*CHANGE MATERIAL, NAME=M\n*CHANGE PLASTIC\n 20., 0.\n 30., 0.1\n"), "a.inp");
  EXPECT_EQ(input.runs[0].materials[0].plasticity.points[0][1], 5);
  EXPECT_EQ(input.runs[1].materials[0].plasticity.points[0][1], 20);
}

TEST(ChangesOfSteps, AddEquations) {
  const auto input = inp::parse_input(
      with_friction("0.") + step(press) + step("*EQUATION\n 2\n 5, 3, 1., 6, 3, -1.\n"), "a.inp");
  EXPECT_TRUE(input.runs[0].relations.empty());
  EXPECT_EQ(input.runs[1].relations.size(), 1U);
}

TEST(ChangesOfSteps, GiveANewForceToAPartOfTheNodes) {
  const auto input = inp::parse_input(
      test::with_step("*STATIC\n*CLOAD\n ALL, 1, 3.\n*END STEP\n*STEP\n*STATIC\n*CLOAD\n ONE, 1, 5.\n"),
      "a.inp");
  const auto& study = input.runs[1];
  ASSERT_EQ(study.loads.size(), 2U);
  EXPECT_EQ(study.loads[0].on, "ALL_without_ONE");
  EXPECT_EQ(*study.loads[0].components[0].number(), 3);
  EXPECT_EQ(study.loads[1].on, "ONE");
  EXPECT_EQ(value_at(study.functions.at(study.loads[1].function), 1), 0.6); // from 3 to 5
  EXPECT_EQ(input.runs[0].mesh, study.mesh);
}

TEST(ExplicitStepsOfFiles, GoOnFromStaticOnes) {
  // A column of the two cubes without contact: a force on the roof of the lower one, and it stays in balance.
  auto text = with_friction("0.");
  text.erase(text.find("*SURFACE INTERACTION"), text.find("*BOUNDARY") - text.find("*SURFACE INTERACTION"));
  const auto runs =
      computed(text + "*BOUNDARY\n LID, 3\n" + step("*CLOAD\n 5, 3, 1.\n 6, 3, 1.\n 7, 3, 1.\n 8, 3, 1.\n") +
               "*STEP\n*DYNAMIC, EXPLICIT\n , 3.\n*END STEP\n*STEP\n*STATIC\n*CLOAD, OP=NEW\n*END STEP\n");
  EXPECT_NEAR(roof(runs, 0, 2), 4 / young, 1e-12);
  EXPECT_NEAR(roof(runs, 1, 2), 4 / young, 1e-9);
  EXPECT_NEAR(roof(runs, 2, 2), 0, 1e-12);
}

TEST(ExplicitStepsOfFiles, HaveContactOnNodesAndMassScaling) {
  const auto study =
      inp::parse_input(with_friction("0.1") + "*STEP\n*DYNAMIC, EXPLICIT\n , 1., 1.E-3\n*END STEP\n", "a.inp")
          .runs[0];
  EXPECT_EQ(study.contact[0].integration.by, study::ContactIntegration::nodes);
  EXPECT_EQ(study.contact[0].method, study::ContactMethod::penalty);
  EXPECT_EQ(study.time.mass_scaling, 1e-3);
}

TEST(NlgeomOfFiles, TurnsPressuresAndSpringsWithTheBodies) {
  auto text = test::cube;
  text.replace(text.find("*MATERIAL"), 9,
               "*ELEMENT, TYPE=SPRINGA, ELSET=S\n 5, 1, 7\n*SPRING, ELSET=S\n\n 10.\n*MATERIAL");
  const auto of = [&](const std::string& head) {
    return inp::parse_input(text + head + "\n*STATIC\n*DLOAD\n E, P1, 2.\n*END STEP\n", "a.inp").runs[0];
  };
  EXPECT_TRUE(of("*STEP, NLGEOM").loads[0].follower);
  EXPECT_TRUE(of("*STEP, NLGEOM").connectors[0].rotates);
  EXPECT_FALSE(of("*STEP").loads[0].follower);
  EXPECT_FALSE(of("*STEP").connectors[0].rotates);
}

} // namespace
} // namespace rubato::changes_test
