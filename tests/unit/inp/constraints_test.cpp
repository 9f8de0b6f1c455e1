// SPDX-License-Identifier: LGPL-3.0-or-later
// Couplings, own axes of nodes, nodes without elements and multi-point constraints, beside CalculiX 2.20.
#include "rubato/inp/read.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <gtest/gtest.h>

#include "bars.hpp"
#include "support/faults.hpp"
#include <string>
#include <vector>

namespace rubato::constraints_test {
namespace {

using test::Box;

const Box bar{{4, 2, 2}, {10, 2, 2}};

std::string model_of_bar(const std::string& nodes, const std::string& lines, const std::string& type,
                         const std::string& held) {
  return "*NODE, NSET=NALL\n" + bar.nodes() + "*NODE\n" + nodes + "*ELEMENT, TYPE=" + type +
         ", ELSET=EALL\n" + bar.elements() + "*NSET, NSET=ROOT\n" + bar.layer(0, 0) + "*NSET, NSET=TIP\n" +
         bar.layer(0, 4) +
         "*ELSET, ELSET=ETIP\n4, 8, 12, 16\n*SURFACE, NAME=STIP\nETIP, S4\n"
         "*MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n"
         "*BOUNDARY\n" +
         held + lines;
}

std::string bar_with(const std::string& nodes, const std::string& lines, const std::string& step,
                     const std::string& type = "C3D8", const std::string& held = "ROOT, 1, 3\n") {
  return model_of_bar(nodes, lines, type, held) + "*STEP\n*STATIC\n" + step + "*END STEP\n";
}

/// The root is held along the bar alone.
const std::string free_to_narrow = "ROOT, 1\n1, 2, 3\n11, 3\n";

struct Row {
  const char* what;
  const char* nodes;
  const char* model;
  const char* step;
  Eigen::Vector3d low;  ///< displacement of the corner (10, 0, 0) by CalculiX
  Eigen::Vector3d high; ///< of (10, 2, 2)
};

/// Files of seven digits; MPCs of CalculiX are not linear.
constexpr double digits = 1e-6;
constexpr double not_linear = 1e-5;

void expect_rows(const std::vector<Row>& rows, double tolerance) {
  for (const auto& row : rows) {
    const auto ours = test::computed_text(bar_with(row.nodes, row.model, row.step));
    const double size = std::max(row.low.norm(), row.high.norm());
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(ours.displacement(0, {10, 0, 0}, axis), row.low[axis], tolerance * size) << row.what;
      EXPECT_NEAR(ours.displacement(0, {10, 2, 2}, axis), row.high[axis], tolerance * size) << row.what;
    }
  }
}

TEST(ConstraintsOfFiles, AreThoseOfCalculix) {
  expect_rows(
      {{"a rigid coupling with a moment",
        "9999, 12., 1., 1.3\n",
        "*COUPLING, REF NODE=9999, SURFACE=STIP, CONSTRAINT NAME=C1\n*KINEMATIC\n1,3\n",
        "*CLOAD\n9999, 5, 5000.\n",
        {-0.1060792, -6.502334e-14, -0.530396},
        {0.1060792, -7.458427e-14, -0.530396}},
       {"a coupling around an axis that twists",
        "9999, 10., 1., 1.\n",
        "*ORIENTATION,NAME=OR,SYSTEM=CYLINDRICAL\n0.,1.,1.,10.,1.,1.\n*COUPLING, REF NODE=9999, "
        "SURFACE=STIP, CONSTRAINT NAME=C1, ORIENTATION=OR\n*KINEMATIC\n2,2\n",
        "*BOUNDARY\n9999,4,4,.01\n9999,1,3\n9999,5,6\n",
        {2.158561e-17, 0.01, -0.01},
        {-1.297797e-17, -0.01, 0.01}},
       {"a distributed force along the bar",
        "9999, 12., 1., 1.3\n",
        "*COUPLING, REF NODE=9999, SURFACE=STIP, CONSTRAINT NAME=C1\n*DISTRIBUTING\n1,6\n",
        "*CLOAD\n9999, 1, 1000.\n",
        {0.005184957, 0.0001531309, -0.03153102},
        {0.01808252, -0.0005597686, -0.03224392}},
       {"a distributed force across the bar",
        "9999, 12., 1., 1.3\n",
        "*COUPLING, REF NODE=9999, SURFACE=STIP, CONSTRAINT NAME=C1\n*DISTRIBUTING\n1,6\n",
        "*CLOAD\n9999, 3, 100.\n",
        {0.01492269, 0.0001913462, 0.09323625},
        {-0.01492269, 0.0001913462, 0.09323625}},
       {"a distributed torque",
        "9999, 12., 1., 1.3\n",
        "*COUPLING, REF NODE=9999, SURFACE=STIP, CONSTRAINT NAME=C1\n*DISTRIBUTING\n1,6\n",
        "*CLOAD\n9999, 4, 5000.\n",
        {1.349332e-15, 0.2321429, -0.2321429},
        {-1.346145e-15, -0.2321429, 0.2321429}},
       {"a distributed moment",
        "9999, 12., 1., 1.3\n",
        "*COUPLING, REF NODE=9999, SURFACE=STIP, CONSTRAINT NAME=C1\n*DISTRIBUTING\n1,6\n",
        "*CLOAD\n9999, 5, 5000.\n",
        {-0.1074796, -0.003388648, -0.5314579},
        {0.1074796, -0.003388648, -0.5314579}},
       {"a rigid coupling with axes",
        "9999, 12., 1., 1.3\n",
        "*ORIENTATION,NAME=OR,SYSTEM=RECTANGULAR\n1.,1.,0.,-1.,1.,0.\n*COUPLING, REF NODE=9999, "
        "SURFACE=STIP, CONSTRAINT NAME=C1, ORIENTATION=OR\n*KINEMATIC\n1,3\n",
        "*CLOAD\n9999, 2, 100.\n",
        {0.01485109, 0.09178739, 0.001392857},
        {-0.01485109, 0.0945731, -0.001392857}},
       {"a distributed moment along own axes",
        "9999, 12., 1., 1.3\n",
        "*ORIENTATION,NAME=OR,SYSTEM=RECTANGULAR\n1.,1.,0.,-1.,1.,0.\n*COUPLING, REF NODE=9999, "
        "SURFACE=STIP, CONSTRAINT NAME=C1, ORIENTATION=OR\n*DISTRIBUTING\n1,6\n",
        "*CLOAD\n9999, 5, 1000.\n",
        {-0.01519992, -0.03330918, -0.04232954},
        {0.01519992, 0.03235073, -0.1079895}},
       {"a distributed force around an axis",
        "9999, 12., 2., 2.\n",
        "*ORIENTATION,NAME=OR,SYSTEM=CYLINDRICAL\n0.,1.,1.,10.,1.,1.\n*COUPLING, REF NODE=9999, "
        "SURFACE=STIP, CONSTRAINT NAME=C1, ORIENTATION=OR\n*DISTRIBUTING\n1,3\n",
        "*CLOAD\n9999,2,100.\n",
        {8.779737e-16, -0.05922669, 0.05922669},
        {-8.604228e-16, -0.07235868, 0.07235868}},
       {"supports and forces along turned axes",
        "",
        "*TRANSFORM, NSET=TIP, TYPE=R\n1.,1.,0.,-1.,1.,.3\n",
        "*BOUNDARY\nTIP,2,2\nTIP,1,1,.01\n*CLOAD\nTIP,3,10.\n",
        {0.007253445, 0.006888691, 0.001215845},
        {0.007146502, 0.006995634, 0.0005028916}},
       {"supports and forces around an axis",
        "",
        "*TRANSFORM, NSET=TIP, TYPE=C\n0.,-3.,-2.,10.,-3.,-2.\n",
        "*BOUNDARY\nTIP,2,2,.02\n*CLOAD\nTIP,1,10.\n",
        {0.001284369, -0.009083198, 0.01798154},
        {-0.00123251, -0.009766933, 0.01779895}},
       {"equations along axes",
        "",
        "*TRANSFORM, NSET=TIP, "
        "TYPE=C\n0.,-3.,-2.,10.,-3.,-2.\n*EQUATION\n2\n5,1,1.,45,1,-2.\n3\n5,2,1.,45,2,-1.,25,2,-.5\n",
        "*CLOAD\nTIP,1,10.\nTIP,2,5.\n",
        {0.00117707, -0.006811032, 0.01332104},
        {-3.708717e-05, -0.004934863, 0.007546903}},
       {"equations with a node without elements",
        "9999, 20., 1., 1.\n",
        "*EQUATION\n2\n5,1,1.,9999,1,-1.\n2\n10,1,1.,9999,1,-1.\n2\n15,1,1.,9999,1,-1.\n2\n20,1,1.,9999,1,-1."
        "\n2\n25,1,1.,9999,1,-1.\n2\n30,1,1.,9999,1,-1.\n2\n35,1,1.,9999,1,-1.\n2\n40,1,1.,9999,1,-1.\n2\n45,"
        "1,1.,9999,1,-1.\n",
        "*CLOAD\n9999,1,1000.\n",
        {0.0116354, 0.0003566389, 0.0003566389},
        {0.0116354, -0.0003566389, -0.0003566389}},
       {"a node without elements that moves",
        "9999, 20., 1., 1.\n",
        "*EQUATION\n2\n5,1,1.,9999,1,-1.\n2\n10,1,1.,9999,1,-1.\n2\n15,1,1.,9999,1,-1.\n2\n20,1,1.,9999,1,-1."
        "\n2\n25,1,1.,9999,1,-1.\n2\n30,1,1.,9999,1,-1.\n2\n35,1,1.,9999,1,-1.\n2\n40,1,1.,9999,1,-1.\n2\n45,"
        "1,1.,9999,1,-1.\n",
        "*BOUNDARY\n9999,1,1,.1\n",
        {0.1, 0.003065119, 0.003065119},
        {0.1, -0.003065119, -0.003065119}},
       {"springs between nodes without elements",
        "9999, 12., 3., 1.\n9998, 12., 5., 1.\n",
        "*ELEMENT,TYPE=SPRINGA,ELSET=SP\n900,25,9999\n*SPRING,ELSET=SP\n\n5000.\n*ELEMENT,TYPE=SPRING1,ELSET="
        "SG\n901,9999\n*SPRING,ELSET=SG\n1\n2000.\n*ELEMENT,TYPE=SPRING1,ELSET=SH\n902,9999\n*SPRING,ELSET="
        "SH\n3\n100.\n*ELEMENT,TYPE=SPRING2,ELSET=S2\n903,9999,9998\n*SPRING,ELSET=S2\n2,2\n3000.\n*"
        "BOUNDARY\n9998,1,3\n",
        "*CLOAD\nTIP,1,100.\n9999,2,50.\n",
        {0.01154681, 0.002798303, 0.0004018381},
        {0.01083598, 0.002006391, -0.0003900739}}},
      digits);
}

TEST(ConstraintsOfFiles, HaveMpcsOfCalculixToFirstOrder) {
  expect_rows({{"PLANE",
                "",
                "*MPC\nPLANE,5,15,35,10,45,25,20\n",
                "*CLOAD\n5,1,.01\n45,2,.02\n25,3,.03\n",
                {5.877613e-06, 1.461021e-05, 2.355422e-05},
                {-5.678815e-06, 1.66722e-05, 2.166699e-05}},
               {"STRAIGHT",
                "",
                "*MPC\nSTRAIGHT,5,10,15\n",
                "*CLOAD\n5,1,.01\n45,2,.02\n25,3,.03\n",
                {5.932983e-06, 1.460475e-05, 2.358903e-05},
                {-5.642511e-06, 1.666529e-05, 2.166153e-05}},
               {"BEAM",
                "",
                "*MPC\nBEAM,5,45\n",
                "*CLOAD\n5,1,.01\n45,2,.02\n25,3,.03\n",
                {6.003534e-06, 1.465742e-05, 2.360083e-05},
                {-5.621892e-06, 1.663184e-05, 2.162638e-05}},
               {"MEANROT that is given",
                "9999,1.,0.,0.\n",
                "*MPC\nMEANROT,5,5,5,15,15,15,35,35,35,45,45,45,9999\n",
                "*BOUNDARY\n9999,1,1,1.e-5\n",
                {-1.142965e-19, 1e-05, -1e-05},
                {8.013518e-20, -1e-05, 1e-05}},
               {"MEANROT with a moment",
                "9999,1.,0.,0.\n",
                "*MPC\nMEANROT,5,5,5,15,15,15,35,35,35,45,45,45,9999\n",
                "*CLOAD\n9999,1,1.\n",
                {8.927576e-19, 4.702339e-05, -4.702339e-05},
                {-8.831911e-19, -4.702339e-05, 4.702339e-05}}},
              not_linear);
}

/// Along the bar alone: strain F/EA all over, and the end is free to narrow.
TEST(ConstraintsOfFiles, CoupleOneDirectionOnly) {
  const auto ours = test::computed_text(bar_with("9999, 10., 1., 1.\n",
                                                 "*COUPLING, REF NODE=9999, SURFACE=STIP, "
                                                 "CONSTRAINT NAME=C\n*KINEMATIC\n1, 1\n",
                                                 "*CLOAD\n9999, 1, 8400.\n", "C3D8", free_to_narrow));
  constexpr double strain = 0.01;
  for (const double y : {0.0, 2.0})
    EXPECT_NEAR(ours.displacement(0, {10, y, 2}, 0), 10 * strain, 1e-12);
  EXPECT_NEAR(ours.displacement(0, {10, 2, 2}, 1), -0.3 * 2 * strain, 1e-12);
}

/// Shares of the area: the stress is the same all over, which equal shares of nodes would not give.
TEST(ConstraintsOfFiles, DistributeForcesByArea) {
  const auto ours = test::computed_text(bar_with("9999, 12., 1., 1.\n",
                                                 "*COUPLING, REF NODE=9999, SURFACE=STIP, "
                                                 "CONSTRAINT NAME=C\n*DISTRIBUTING\n",
                                                 "*CLOAD\n9999, 1, 8400.\n", "C3D8", free_to_narrow));
  for (const double y : {0.0, 1.0, 2.0})
    EXPECT_NEAR(ours.displacement(0, {10, y, 0}, 0), 0.1, 1e-12);
}

/// An equation of sets is one equation for each of their nodes.
TEST(ConstraintsOfFiles, HaveEquationsOfSets) {
  const auto ours = test::computed_text(bar_with(
      "9999, 20., 0., 0.\n", "*EQUATION\n2\nTIP, 1, 1., 9999, 1, -1.\n", "*BOUNDARY\n9999, 1, 1, 0.1\n"));
  for (const double y : {0.0, 1.0, 2.0})
    for (const double z : {0.0, 1.0, 2.0})
      EXPECT_NEAR(ours.displacement(0, {10, y, z}, 0), 0.1, 1e-12);
}

/// Springs of 1000 and 3000 between the end of the bar, which moves by 0.4, and the ground: the node between
/// them moves by 0.1 and by what a force on it adds.
TEST(ConstraintsOfFiles, HaveSpringsBetweenNodesWithoutElements) {
  const auto ours = test::computed_text(bar_with(
      "9998, 11., 0., 0.\n9999, 12., 0., 0.\n9997, 20., 0., 0.\n",
      "*BOUNDARY\n9999, 1, 3\n*ELEMENT, TYPE=SPRINGA, ELSET=A\n900, 5, 9998\n*SPRING, ELSET=A\n\n1000.\n"
      "*ELEMENT, TYPE=SPRINGA, ELSET=B\n901, 9998, 9999\n*SPRING, ELSET=B\n\n3000.\n"
      "*BOUNDARY\n9998, 2, 3\n",
      "*BOUNDARY\nTIP, 1, 1, 0.4\n*CLOAD\n9998, 1, 100.\n"));
  EXPECT_NEAR(ours.displacement(0, {11, 0, 0}, 0), 0.1 + 100.0 / 4000, 1e-12);
}

/// 1000 u + 10⁶ (u − 0.02) = 100 once the gap is closed; 1000 u = 10 while it is open.
TEST(ConstraintsOfFiles, HaveGapsThatClose) {
  for (const auto& [force, moved] : {std::pair(100.0, 20100 / 1001000.0), std::pair(10.0, 0.01)}) {
    const auto ours = test::computed_text(bar_with(
        "9998, 11., 0., 0.\n9999, 12., 0., 0.\n",
        "*BOUNDARY\n9999, 1, 3\n9998, 2, 3\n*ELEMENT, TYPE=SPRINGA, ELSET=A\n900, 9998, 9999\n*SPRING, "
        "ELSET=A\n\n1000.\n*ELEMENT, TYPE=GAPUNI, ELSET=G\n901, 9998, 9999\n*GAP, ELSET=G\n0.02, 1., 0., "
        "0., , 1.e6\n",
        fmt::format("*CLOAD\n9998, 1, {}\n5, 1, 1.\n", force)));
    EXPECT_NEAR(ours.displacement(0, {11, 0, 0}, 0), moved, 1e-12);
  }
}

/// A force in the cut of a bar between two walls, and a shortening, beside CalculiX 2.20.
TEST(ConstraintsOfFiles, TightenBoltsAsCalculix) {
  const std::string cut =
      "*ELSET, ELSET=EMID\n2, 6, 10, 14\n*SURFACE, NAME=CUT\nEMID, S4\n*PRE-TENSION "
      "SECTION, SURFACE=CUT, NODE=9999\n1., 0., 0.\n*NSET, NSET=PN\n9999\n*BOUNDARY\nTIP, "
      "1, 3\n";
  const auto pulled = test::computed_text(bar_with("9999, 5., 1., 1.\n", cut, "*CLOAD\n9999, 1, 1000.\n"));
  const auto shorter =
      test::computed_text(bar_with("9999, 5., 1., 1.\n", cut, "*BOUNDARY\nPN, 1, 1, 0.01\n"));
  EXPECT_NEAR(pulled.displacement(0, {7.5, 0, 0}, 0), -0.002703998, 1e-8);
  EXPECT_NEAR(shorter.displacement(0, {7.5, 0, 0}, 0), -0.002379012, 1e-8);
}

TEST(ConstraintsOfFiles, AreRefusedWhereTheyCannotHold) {
  struct Bad {
    std::string text;
    std::string expected; ///< a part of the message
  };
  for (const auto& [text, expected] : std::vector<Bad>{
           {bar_with("9999, 5., 1., 1.\n",
                     "*SURFACE, NAME=N, TYPE=NODE\nTIP\n*PRE-TENSION SECTION, SURFACE=N, NODE=9999\n", ""),
            "found a pre-tension section without faces"},
           {bar_with("9999, 5., 1., 1.\n",
                     "*ELSET, ELSET=EMID\n2, 6, 10, 14\n*SURFACE, NAME=CUT\nEMID, S4\n*PRE-TENSION SECTION, "
                     "SURFACE=CUT, NODE=9999\n",
                     "*CLOAD\n9999, 1, -5.\n"),
            "found the pre-tension -5, expected one above 0"},
           {bar_with("", "*MPC\nDIST, 5, 10\n", ""),
            "found an MPC of type 'DIST', expected PIN, TIE, LINEAR"},
           {bar_with("", "*MPC\nPLANE, 5, 10, 15\n", ""), "found 3 nodes of an MPC of type PLANE"},
           {bar_with("", "*MPC\nPLANE, 5, 10, 15, 20\n", ""), "found three first nodes on a line"},
           {bar_with("", "*TRANSFORM, NSET=TIP\n1., 0., 0., 2., 0., 0.\n", ""),
            "found two points that give no axes"},
           {bar_with("", "*TRANSFORM, NSET=TIP, TYPE=Q\n1., 0., 0., 2., 0., 0.\n", ""),
            "found TYPE=Q, expected R, C or S"},
           {bar_with("9999, 12., 1., 1.\n",
                     "*COUPLING, REF NODE=9999, SURFACE=STIP\n*DISTRIBUTING, CYCLIC SYMMETRY\n1, 3\n", ""),
            "found a coupling of a sector of a cyclic structure"},
           {bar_with("", "*COUPLING, REF NODE=5, SURFACE=STIP\n*DISTRIBUTING\n1, 3\n", ""),
            "found the reference node 5 among the nodes that it is the mean of"}}) {
    const auto fault = test::fault_of([&] { inp::parse_input(text, "a.inp"); });
    EXPECT_NE(fault.find(expected), std::string::npos) << fault;
  }
}

TEST(ConstraintsOfFiles, LeaveNoNodeWithoutElementsFree) {
  const auto text = bar_with("9999, 12., 1., 1.\n9998, 13., 1., 1.\n",
                             "*EQUATION\n2\n9999, 1, 1., 9998, 1, -1.\n", "*CLOAD\n5, 1, 1.\n");
  const auto fault = test::fault_of([&] { test::computed_text(text); });
  EXPECT_NE(fault.find("node N9998 (13, 1, 1), which belongs to no cell, is not held"), std::string::npos)
      << fault;
}

/// A line about a node that nothing has is left out, and a note says so.
TEST(ConstraintsOfFiles, LeaveOutLinesOfUnusedNodes) {
  const auto input = inp::parse_input(
      bar_with("9999, 12., 1., 1.\n", "*BOUNDARY\n9999, 1, 3\n", "*CLOAD\n5, 1, 1.\n"), "a.inp");
  EXPECT_TRUE(std::ranges::any_of(input.notes, [](const std::string& note) {
    return note.find("has the nodes of 'N9999': the line is left out") != std::string::npos;
  }));
}

/// The generated mesh, written number by number.
TEST(MeshesOfFiles, AreGenerated) {
  const auto content = mesh::inp::read_content(test::inp_file("points"));
  const auto twin = mesh::inp::parse_content(bar_with("", "", ""), "a.inp");
  ASSERT_GT(content.points.size(), 45U);
  for (const auto& [number, node] : twin.node_at[0]) {
    ASSERT_TRUE(content.node_at[0].contains(number)) << number;
    EXPECT_LT((content.points[static_cast<std::size_t>(content.node_at[0].at(number))] -
               twin.points[static_cast<std::size_t>(node)])
                  .norm(),
              1e-12)
        << number;
  }
  const auto numbers_of = [](const mesh::inp::Content& of, std::int64_t element) {
    std::vector<std::int64_t> numbers;
    const auto index = static_cast<std::size_t>(of.element_at[0].at(element));
    for (const auto node : of.nodes_of(of.elements[index]))
      numbers.push_back(of.node_numbers[static_cast<std::size_t>(node)]);
    return numbers;
  };
  for (std::int64_t element = 1; element <= 16; ++element)
    EXPECT_EQ(numbers_of(content, element), numbers_of(twin, element)) << element;
  EXPECT_EQ(content.element_sets.at({0, "EALL"}).items.size(), 16U);
  EXPECT_EQ(content.node_sets.at({0, "NALL"}).items.size(), 45U);
  // x' along y, y' along −x, from (12, 0, 0).
  const auto place = [&](std::int64_t number) {
    return content.points[static_cast<std::size_t>(content.node_at[0].at(number))];
  };
  EXPECT_LT((place(100) - Eigen::Vector3d(12, 1, 1)).norm(), 1e-12);
  EXPECT_LT((place(200) - Eigen::Vector3d(13, 0, 0)).norm(), 1e-12);
}

/// A quarter of a circle of radius 2, and distances that halve from one end to the other.
TEST(MeshesOfFiles, HaveArcsAndBiasedLines) {
  const auto content = mesh::inp::parse_content(
      bar_with("101, 2., 0., 5.\n105, 0., 2., 5.\n120, 0., 0., 5.\n201, 0., 0., 7.\n301, 7., 0., 7.\n"
               "*NSET, NSET=FROM\n201\n*NSET, NSET=TO\n301\n*NGEN, LINE=C\n101, 105, 1, 120\n*NFILL, "
               "BIAS=2.\nFROM, TO, 3, 1\n",
               "", ""),
      "a.inp");
  const auto place = [&](std::int64_t number) {
    return content.points[static_cast<std::size_t>(content.node_at[0].at(number))];
  };
  EXPECT_LT((place(103) - Eigen::Vector3d(std::sqrt(2), std::sqrt(2), 5)).norm(), 1e-12);
  EXPECT_LT((place(202) - Eigen::Vector3d(4, 0, 7)).norm(), 1e-12);
  EXPECT_LT((place(203) - Eigen::Vector3d(6, 0, 7)).norm(), 1e-12);
}

TEST(ConstraintsOfFiles, OfSeveralKindsHoldTogether) {
  const auto ours = test::computed("points");
  // The end turns by 0.001 about the bar.
  EXPECT_NEAR(ours.displacement(0, {10, 2, 1}, 2) - ours.displacement(0, {10, 0, 1}, 2), 0.002, 1e-12);
  EXPECT_NEAR(ours.displacement(0, {10, 1, 2}, 1) - ours.displacement(0, {10, 1, 0}, 1), -0.002, 1e-12);
  EXPECT_GT(std::abs(ours.displacement(0, {10, 2, 1}, 0)), 1e-9);
  // Around the line through (0, −3, 1) nothing moves at the side, which is turned from it by an angle.
  const Eigen::Vector2d out = Eigen::Vector2d(3, -1).normalized();
  EXPECT_NEAR(-out.y() * ours.displacement(0, {5, 0, 0}, 1) + out.x() * ours.displacement(0, {5, 0, 0}, 2), 0,
              1e-12);
  // Section x = 5 stays plane along x.
  EXPECT_NEAR(ours.displacement(0, {5, 2, 2}, 0) + ours.displacement(0, {5, 0, 0}, 0),
              ours.displacement(0, {5, 2, 0}, 0) + ours.displacement(0, {5, 0, 2}, 0), 1e-12);
}

TEST(ElementsOfFiles, HaveTheFormulationOfTheirType) {
  const auto formulation = [](const std::string& type) {
    const auto input = inp::parse_input(bar_with("", "", "*CLOAD\n5, 1, 1.\n", type), "a.inp");
    return input.runs.front().materials.front().formulation;
  };
  EXPECT_EQ(formulation("C3D8"), std::nullopt);
  EXPECT_EQ(formulation("C3D8R"), study::Formulation::reduced);
  EXPECT_EQ(formulation("C3D8I"), study::Formulation::enhanced);
}

TEST(ElementsOfFiles, AreSplitByFormulationWhereASectionHasSeveral) {
  auto text = bar_with("", "", "*CLOAD\n5, 1, 1.\n", "C3D8I");
  const auto at = text.find("3, 3, 4");
  ASSERT_NE(at, std::string::npos);
  text.insert(at, "*ELEMENT, TYPE=C3D8, ELSET=EALL\n");
  const auto study = inp::parse_input(text, "a.inp").runs.front();
  ASSERT_EQ(study.materials.size(), 2U);
  EXPECT_EQ(study.materials[0].cells, std::vector<std::string>{"EALL.full"});
  EXPECT_EQ(study.materials[1].name, "STEEL_enhanced");
  EXPECT_EQ(study.materials[1].cells, std::vector<std::string>{"EALL.incompatible"});
  EXPECT_GT(std::abs(test::computed_text(text).displacement(0, {10, 0, 0}, 0)), 0);
}

} // namespace
} // namespace rubato::constraints_test
