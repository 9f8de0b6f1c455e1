// SPDX-License-Identifier: LGPL-3.0-or-later
// A cube under a force along z, by its material: lengths from closed forms.
#include "rubato/inp/read.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "computed.hpp"
#include "small_files.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <cmath>
#include <fstream>
#include <functional>

namespace rubato::laws_of_files_test {
namespace {

constexpr double young = 2e5;
const std::string elastic = "*ELASTIC\n 2.E5, 0.3\n";

/// The cube of 1 x 1 x 1, free to narrow.
std::string file_of(const std::string& material, const std::string& steps, const std::string& model = "") {
  return "*NODE, NSET=ALL\n" + test::cube_nodes + R"(*NSET, NSET=TOP
 5, 6, 7, 8
*NSET, NSET=BOTTOM
 1, 2, 3, 4
*NSET, NSET=EDGE
 1, 4
*ELEMENT, TYPE=C3D8, ELSET=E
 1, 1, 2, 3, 4, 5, 6, 7, 8
*MATERIAL, NAME=M
)" + material +
         R"(*SOLID SECTION, ELSET=E, MATERIAL=M
*BOUNDARY
 BOTTOM, 3
 1, 1, 2
 2, 2
 4, 1
)" + model +
         steps;
}

double root(const std::function<double(double)>& f, double low, double high) {
  for (int i = 0; i < 200; ++i)
    (f(low) * f(0.5 * (low + high)) <= 0 ? high : low) = 0.5 * (low + high);
  return 0.5 * (low + high);
}

std::string step(double force, const std::string& head = "*STEP", const std::string& rest = "") {
  return fmt::format("{}\n*STATIC, DIRECT\n 0.05, 1.\n*CLOAD\n TOP, 3, {}\n{}*END STEP\n", head, force / 4,
                     rest);
}

test::Computed computed(const std::string& text) {
  const test::ScratchFolder folder;
  std::ofstream(folder / "a.inp") << text;
  return test::Computed(inp::read_input(folder / "a.inp").runs);
}

/// Compares the displacement of the top at the end of each step.
void expect_moves(const std::string& text, const std::vector<double>& moves, double tolerance = 1e-7) {
  const auto runs = computed(text);
  ASSERT_EQ(runs.size(), moves.size());
  for (std::size_t run = 0; run < moves.size(); ++run)
    EXPECT_NEAR(runs.displacement(run, {1, 1, 1}, 2), moves[run], tolerance * std::abs(moves[run]))
        << text << "step " << run + 1;
}

TEST(PlasticityOfFiles, FollowsTablesAndEndsFlat) {
  const std::string table = elastic + "*PLASTIC\n 200., 0.\n 300., 0.1\n 320., 0.2,\n";
  expect_moves(file_of(table, step(250)), {250 / young + 0.05});
  expect_moves(file_of(table, step(310) + step(0)), {310 / young + 0.15, 0.15});
  // With an imposed displacement the width follows from the stress.
  const auto expect_stress = [](const std::string& lines, double move,
                                const std::function<double(double)>& at) {
    const auto pulled = computed(file_of(
        elastic + "*PLASTIC\n" + lines,
        fmt::format("*STEP\n*STATIC, DIRECT\n 0.1, 1.\n*BOUNDARY\n TOP, 3, 3, {}\n*END STEP\n", move)));
    const double stress = root([&](double s) { return at(move - s / young) - s; }, 0, 1000);
    EXPECT_NEAR(pulled.displacement(0, {1, 1, 1}, 0), -0.3 * stress / young - 0.5 * (move - stress / young),
                1e-9);
  };
  // Beyond the last line the stress stays.
  expect_stress(" 200., 0.\n 300., 0.1\n 320., 0.2,\n", 0.4, [](double) { return 320.0; });
  // Yielding begins at the first stress whatever its strain.
  expect_stress(" 200., 0.05\n 300., 0.1\n", 0.08, [](double p) { return 200 + 2000 * (p - 0.05); });
}

TEST(PlasticityOfFiles, MovesTheYieldSurface) {
  // Kinematic: yielding back begins 400 below the turn.
  const std::string kinematic = elastic + "*PLASTIC, HARDENING=KINEMATIC\n 200., 0.\n 300., 0.1\n";
  expect_moves(file_of(kinematic, step(250) + step(-200)), {250 / young + 0.05, -200 / young + 0});
  // Combined by parameters: 200 + 40 (1 - exp(-5 p)) + 1000/20 (1 - exp(-20 p)).
  const std::string combined = elastic +
                               "*PLASTIC, HARDENING=COMBINED, DATA TYPE=PARAMETERS\n 200., 1000., 20.\n"
                               "*CYCLIC HARDENING, PARAMETERS\n 200., 40., 5.\n";
  const double p = root(
      [](double x) { return 200 + 40 * (1 - std::exp(-5 * x)) + 50 * (1 - std::exp(-20 * x)) - 250; }, 0, 1);
  expect_moves(file_of(combined, "*STEP\n*STATIC, DIRECT\n 0.001, 1.\n*CLOAD\n TOP, 3, 62.5\n*END STEP\n"),
               {250 / young + p}, 5e-3); // of first order in the increment
  // Half a cycle above a yield surface that grows by 600.
  const std::string half = elastic + "*PLASTIC, HARDENING=COMBINED\n 200., 0.\n 300., 0.1\n"
                                     "*CYCLIC HARDENING\n 200., 0.\n 260., 0.1\n";
  // At the turn the back stress is 20 and the surface 230; back it yields from -210 on.
  const double back = 0.01;
  expect_moves(file_of(half, step(250) + step(-(230 - 20) - back * 1000)),
               {250 / young + 0.05, -220 / young + 0.05 - back}, 1e-6);
}

TEST(PlasticityOfFiles, IsFittedToTheCurveOfHalfACycle) {
  std::string text = elastic + "*PLASTIC, HARDENING=COMBINED\n";
  for (const double p : {0.0, 0.01, 0.02, 0.05, 0.1, 0.2})
    text += fmt::format(" {}, {}\n", 200 + 100 * (1 - std::exp(-30 * p)), p);
  const auto study = inp::parse_input(file_of(text, step(250)), "a.inp").runs[0];
  ASSERT_EQ(study.materials[0].plasticity.kinematic.size(), 1U);
  EXPECT_NEAR(study.materials[0].plasticity.kinematic[0].recall, 30, 1e-3);
  EXPECT_NEAR(study.materials[0].plasticity.kinematic[0].modulus, 3000, 0.1);
}

TEST(PlasticityOfFiles, HasJohnsonAndCooksNumbers) {
  const auto material =
      inp::parse_input(file_of(elastic +
                                   "*PLASTIC, HARDENING=JOHNSON COOK\n 200., 500., 0.3, 1., 1500., 20.\n"
                                   "*RATE DEPENDENT, TYPE=JOHNSON COOK\n 0.01, 0.1\n",
                               step(250), "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, 390.\n"),
                       "a.inp")
          .runs[0]
          .materials[0];
  EXPECT_EQ(material.plasticity.hardening, study::HardeningKind::johnson_cook);
  EXPECT_NEAR(material.plasticity.yield_stress, 150, 1e-12); // a quarter of the way to melting
  EXPECT_NEAR(material.plasticity.factor, 375, 1e-12);
  EXPECT_EQ(material.plasticity.exponent, 0.3);
  EXPECT_EQ(material.plasticity.rate_factor, 0.01);
  EXPECT_EQ(material.plasticity.reference_rate, 0.1);
}

TEST(LargeStrainsOfFiles, AreThoseOfNlgeom) {
  const std::string nlgeom = "*STEP, NLGEOM";
  // Elastic: S = E (l^2 - 1)/2 along the bar.
  const double stretch = root([](double l) { return young * 0.5 * (l * l * l - l) - 2e4; }, 1, 2);
  expect_moves(file_of(elastic, step(2e4, nlgeom)), {stretch - 1});
  expect_moves(file_of(elastic, step(2e4, "*STEP, NLGEOM=YES")), {stretch - 1});
  expect_moves(file_of(elastic, step(2e4, "*STEP, NLGEOM=NO")), {0.1});
  // NLGEOM stays on in the second step, which keeps the force.
  expect_moves(file_of(elastic, step(2e4, nlgeom) + step(2e4)), {stretch - 1, stretch - 1});
  // Plastic: Kirchhoff stress 250 at the plastic strain 0.05.
  const double plastic_stretch = std::exp(250 / young + 0.05);
  expect_moves(file_of(elastic + "*PLASTIC\n 200., 0.\n 300., 0.1\n", step(250 / plastic_stretch, nlgeom)),
               {plastic_stretch - 1});
  // Plastic strain is logarithmic in the steps before NLGEOM, too.
  const auto later =
      inp::parse_input(file_of(elastic + "*PLASTIC\n 200., 0.\n", step(10) + step(20, nlgeom)), "a.inp");
  for (const auto& run : later.runs)
    EXPECT_EQ(run.materials[0].strain, study::StrainKind::logarithmic);
}

/// Force along z of a hyperelastic cube at the stretch 1.5: w(l) is l times the derivative of the isochoric
/// energy by the stretch, at isochoric stretches.
double rubber_force(const std::function<double(double)>& w, double bulk) {
  constexpr double along = 1.5;
  const auto stress = [&](double across, bool axial) {
    const double volume = along * across * across, scale = std::pow(volume, -1.0 / 3);
    const double a = w(along * scale), b = w(across * scale), mean = (a + 2 * b) / 3;
    return (axial ? a : b) - mean + bulk * volume * (volume - 1); // Kirchhoff
  };
  const double across = root([&](double x) { return stress(x, false); }, 0.6, 1.2);
  return stress(across, true) / along;
}

TEST(RubberOfFiles, HasThePotentialsOfTheFile) {
  const auto expect = [](const std::string& keyword, const std::function<double(double)>& w, double bulk) {
    expect_moves(file_of(keyword, step(rubber_force(w, bulk), "*STEP, NLGEOM")), {0.5}, 1e-6);
  };
  const auto neo_hooke = [](double l) { return 2 * l * l; };
  expect("*HYPERELASTIC, NEO HOOKE\n 1., 0.1\n", neo_hooke, 20);
  expect("*HYPERELASTIC, NEO HOOKE\n 1.\n", neo_hooke, 40); // 20 times the shear modulus
  expect(
      "*HYPERELASTIC, MOONEY-RIVLIN\n 1., 0.2, 0.1\n", [](double l) { return 2 * l * l - 0.4 / (l * l); },
      20);
  expect(
      "*HYPERELASTIC\n 1., 0.2, 0.1\n", [](double l) { return 2 * l * l - 0.4 / (l * l); }, 20);
  expect(
      "*HYPERELASTIC, POLYNOMIAL, N=1\n 1., 0.2, 0.1, 20.\n",
      [](double l) { return 2 * l * l - 0.4 / (l * l); }, 20);
  expect(
      "*HYPERELASTIC, OGDEN, N=2\n 1., 2., 0.5, -2., 0.1, 0.\n",
      [](double l) { return l * l - 0.5 / (l * l); }, 20);
}

TEST(RubberOfFiles, HasYeohsPotential) {
  for (const auto* keyword :
       {"*HYPERELASTIC, YEOH\n 1., -0.05, 0.01, 0.1, 0., 0.\n",
        "*HYPERELASTIC, REDUCED POLYNOMIAL, N=3\n 1., -0.05, 0.01, 0.1\n",
        "*HYPERELASTIC, POLYNOMIAL, N=3\n 1., 0., -0.05, 0., 0., 0.01, 0., 0.\n 0., 0.1\n"}) {
    const auto& rubber = inp::parse_input(file_of(keyword, step(1)), "a.inp").runs[0].materials[0];
    EXPECT_EQ(rubber.law, study::LawKind::yeoh) << keyword;
    EXPECT_EQ(rubber.hyperelasticity.c10, 1);
    EXPECT_EQ(rubber.hyperelasticity.c20, -0.05);
    EXPECT_EQ(rubber.hyperelasticity.c30, 0.01);
    EXPECT_EQ(rubber.hyperelasticity.bulk, 20);
    EXPECT_EQ(rubber.hyperelasticity.volume, study::VolumeEnergy::quadratic);
  }
}

TEST(ViscosityOfFiles, RelaxesFromTheGivenModuli) {
  const auto of = [](const std::string& moduli) {
    return inp::parse_input(file_of("*ELASTIC" + moduli +
                                        "\n 2.E5, 0.3\n*VISCOELASTIC, TIME=PRONY\n 0.3, 0., 2.\n"
                                        " 0.2, 0., 10.\n",
                                    "*STEP\n*VISCO\n 0.1, 1.\n*CLOAD\n TOP, 3, 1.\n*END STEP\n"),
                            "a.inp")
        .runs[0];
  };
  constexpr double shear = 2e5 / 2.6, bulk = 2e5 / 1.2;
  for (const bool instantaneous : {false, true}) {
    const auto run = of(instantaneous ? ", MODULI=INSTANTANEOUS" : "");
    const auto& material = run.materials[0];
    const double first = instantaneous ? shear : 2 * shear, last = first / 2;
    ASSERT_EQ(material.prony.size(), 2U);
    EXPECT_NEAR(material.prony[0].shear, 0.3 * first, 1e-9 * first);
    EXPECT_NEAR(material.prony[1].shear, 0.2 * first, 1e-9 * first);
    EXPECT_EQ(material.prony[1].time, 10);
    EXPECT_NEAR(material.young / (2 * (1 + material.poisson)), last, 1e-9 * last);
    EXPECT_NEAR(material.young / (3 * (1 - 2 * material.poisson)), bulk, 1e-9 * bulk);
    EXPECT_TRUE(run.loads[0].function.empty()); // there at once
  }
}

TEST(HeatOfFiles, ChoosesTheNumbersOfMaterials) {
  const std::string warm = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\n ALL, 70.\n";
  const std::string softer = "*ELASTIC\n 2.E5, 0.3, 20.\n 1.E5, 0.3, 220.\n";
  expect_moves(file_of(softer, step(100), warm), {100 / 1.75e5});
  expect_moves(file_of(softer, step(100)), {100 / 2e5}); // 0, below the first
  // The end of each step counts; 220 and beyond it are the same.
  expect_moves(file_of(softer,
                       step(100, "*STEP", "*TEMPERATURE\n ALL, 120.\n") +
                           step(100, "*STEP", "*TEMPERATURE\n ALL, 400.\n"),
                       warm),
               {100 / 1.5e5, 100 / 1e5});
  // Other sets in later steps: all nodes are at 220 in the end.
  expect_moves(file_of(softer,
                       step(100, "*STEP", "*TEMPERATURE\n ALL, 120.\n") +
                           step(100, "*STEP", "*TEMPERATURE\n TOP, 220.\n BOTTOM, 220.\n"),
                       warm),
               {100 / 1.5e5, 100 / 1e5});
  // Expansion from the reference 20: 1.5e-5 100 - 1.25e-5 50 between 70 and 120.
  expect_moves(file_of(softer + "*EXPANSION, ZERO=20.\n 1.E-5, 20.\n 2.E-5, 220.\n",
                       step(100, "*STEP", "*TEMPERATURE\n ALL, 120.\n"), warm),
               {100 / 1.5e5 + 1.5e-5 * 100 - 1.25e-5 * 50});
  // Yield stresses between two tables: 160 at the plastic strain 0, 220 at 0.1.
  expect_moves(file_of(elastic + "*PLASTIC\n 200., 0., 20.\n 240., 0.05, 20.\n 280., 0.1, 20.\n"
                                 " 40., 0., 220.\n 40., 0.1, 220.\n",
                       step(190), warm),
               {190 / young + 0.05});
}

TEST(HeatOfFiles, IsOneTemperatureWhereNumbersDependOnIt) {
  const auto text = file_of("*ELASTIC\n 2.E5, 0.3, 20.\n 1.E5, 0.3, 220.\n",
                            step(1, "*STEP", "*TEMPERATURE\n TOP, 100.\n"));
  const auto several = test::fault_of([&] { inp::parse_input(text, "a.inp"); });
  EXPECT_TRUE(several.starts_with("a.inp:18:17: found numbers of 'M' that depend on the temperature, and "
                                  "temperatures from 0 to 100 in step 1"))
      << several;
  const auto falling = test::fault_of(
      [] { inp::parse_input(file_of("*ELASTIC\n 2.E5, 0.3, 20.\n 1.E5, 0.3, 10.\n", step(1)), "a.inp"); });
  EXPECT_TRUE(falling.starts_with("a.inp:21:2: found numbers for the temperature 10 after those for 20"))
      << falling;
}

TEST(SupportsOfFiles, BeginInLaterStepsAndReplaceOthers) {
  const std::string pulled = "*STEP\n*STATIC\n*BOUNDARY\n TOP, 3, 3, 0.02\n*END STEP\n";
  expect_moves(file_of(elastic, step(2e3) + pulled), {0.01, 0.02});
  const auto later = computed(file_of(elastic, step(2e3) + pulled));
  EXPECT_NEAR(later.displacement(1, {1, 1, 1}, 0), -0.3 * 0.02, 1e-12);
  // A part of the nodes gets another value; the rest stays.
  const auto split = computed(file_of(elastic, "*STEP\n*STATIC\n*BOUNDARY\n ALL, 1\n*END STEP\n"
                                               "*STEP\n*STATIC\n*BOUNDARY\n EDGE, 1, 1, 0.01\n*END STEP\n"));
  EXPECT_EQ(split.displacement(1, {0, 1, 0}, 0), 0.01);
  EXPECT_EQ(split.displacement(1, {1, 1, 0}, 0), 0);
  const auto node = computed(file_of(elastic, "*STEP\n*STATIC\n*BOUNDARY\n ALL, 1\n*END STEP\n"
                                              "*STEP\n*STATIC\n*BOUNDARY\n 4, 1, 1, 0.01\n*END STEP\n"));
  EXPECT_EQ(node.displacement(1, {0, 1, 0}, 0), 0.01);
  EXPECT_EQ(node.displacement(1, {0, 0, 0}, 0), 0);
  // FIXED keeps what was reached.
  expect_moves(file_of(elastic, pulled + "*STEP\n*STATIC\n*BOUNDARY, FIXED\n TOP, 3, 3\n*END STEP\n"),
               {0.02, 0.02});
}

TEST(SupportsOfFiles, ThatJumpInDynamicStepsMoveOverTheFirstIncrement) {
  const auto study =
      inp::parse_input(file_of(elastic + "*DENSITY\n 1.\n", "*STEP\n*DYNAMIC, DIRECT, ALPHA=0.\n 0.1, 1.\n"
                                                            "*BOUNDARY\n TOP, 3, 3, 0.5\n*END STEP\n"),
                       "a.inp")
          .runs[0];
  const auto& held = study.supports.back();
  ASSERT_TRUE(held.components[2]);
  const auto& function = study.functions.at(held.components[2]->function);
  EXPECT_EQ(value_at(function, 0), 0);
  EXPECT_EQ(value_at(function, 0.1), 1);
  EXPECT_EQ(value_at(function, 1), 1);
}

} // namespace
} // namespace rubato::laws_of_files_test
