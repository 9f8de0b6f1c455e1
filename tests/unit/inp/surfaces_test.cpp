// SPDX-License-Identifier: LGPL-3.0-or-later
// Two blocks that touch or are tied: their closed form is a bar under a uniform stress.
#include "rubato/inp/read.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <gtest/gtest.h>

#include "bars.hpp"
#include "support/faults.hpp"
#include <string>
#include <vector>

namespace rubato::surfaces_test {
namespace {

using test::Box;

constexpr double young = 1000;
constexpr double pressure = 10;
/// The sum of the shortenings of both blocks, each 1 high.
constexpr double squeezed = 2 * pressure / young;

const std::string of_faces = "*SURFACE, NAME=SLAVE\nEB, S1\n";
const std::string of_nodes = "*SURFACE, NAME=SLAVE, TYPE=NODE\nUNDER\n";
const std::string hard = "*SURFACE INTERACTION, NAME=SI\n*SURFACE BEHAVIOR\n";

std::string pair_of(const std::string& parameters) {
  return hard + "*CONTACT PAIR, INTERACTION=SI, " + parameters + "\nSLAVE, MASTER\n";
}

/// Two blocks over each other, `gap` apart, the upper one loaded by `load` times the pressure.
std::string blocks(const std::string& slave, const std::string& pair, double gap = 0, double load = 1,
                   const std::string& procedure = "*STATIC\n") {
  const Box low{{2, 2, 1}, {2, 2, 1}};
  const Box high{{2, 2, 1}, {2, 2, 1}, 1 + gap, 101};
  return "*NODE, NSET=ALL\n" + low.nodes() + high.nodes() + "*ELEMENT, TYPE=C3D8, ELSET=EA\n" +
         low.elements() + "*ELEMENT, TYPE=C3D8, ELSET=EB\n" + high.elements() + "*NSET, NSET=GROUND\n" +
         low.layer(2, 0) + "*NSET, NSET=UNDER\n" + high.layer(2, 0) + "*NSET, NSET=OVER\n" +
         high.layer(2, 1) + "*SURFACE, NAME=MASTER\nEA, S2\n" + slave +
         "*MATERIAL, NAME=STEEL\n*ELASTIC\n1000., 0.\n*DENSITY\n1.\n*SOLID SECTION, ELSET=EA, "
         "MATERIAL=STEEL\n*SOLID SECTION, ELSET=EB, MATERIAL=STEEL\n*BOUNDARY\nGROUND, 1, 3\nOVER, 1, 2\n" +
         pair + "*STEP\n" + procedure + "*DLOAD\nEB, P2, " + fmt::format("{}\n*END STEP\n", load * pressure);
}

struct Row {
  const char* what;
  std::string text;
  double gap;
  double sinks; ///< how far the top goes down
};

TEST(SurfacesOfFiles, CarryTheirClosedForm) {
  const std::string tied =
      "*SURFACE INTERACTION, NAME=SI\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1.e6\n"
      "*FRICTION\n1., 1.e6\n*CONTACT PAIR, INTERACTION=SI, TYPE=SURFACE TO SURFACE\n"
      "SLAVE, MASTER\n";
  const std::string clearance = "*CLEARANCE, MASTER=MASTER, SLAVE=SLAVE, VALUE=0.01\n";
  const std::vector<Row> rows{
      {"faces", blocks(of_faces, pair_of("TYPE=NODE TO SURFACE")), 0, squeezed},
      {"nodes", blocks(of_nodes, pair_of("TYPE=NODE TO SURFACE")), 0, squeezed},
      {"nodes, by faces", blocks(of_nodes, pair_of("TYPE=SURFACE TO SURFACE")), 0, squeezed},
      {"LINMORTAR", blocks(of_faces, pair_of("TYPE=LINMORTAR")), 0, squeezed},
      {"PGLINMORTAR", blocks(of_faces, pair_of("TYPE=PGLINMORTAR")), 0, squeezed},
      {"a gap", blocks(of_faces, pair_of("TYPE=SURFACE TO SURFACE"), 0.02), 0.02, squeezed + 0.02},
      {"ADJUST", blocks(of_faces, pair_of("TYPE=SURFACE TO SURFACE, ADJUST=0.03"), 0.02), 0.02, 0.0},
      {"ADJUST of a set", blocks(of_nodes, pair_of("TYPE=NODE TO SURFACE, ADJUST=UNDER"), 0.02), 0.02, 0.0},
      {"ADJUST too small", blocks(of_faces, pair_of("TYPE=SURFACE TO SURFACE, ADJUST=0.01"), 0.02), 0.02,
       squeezed + 0.02},
      {"clearance", blocks(of_faces, pair_of("TYPE=SURFACE TO SURFACE") + clearance), 0, squeezed + 0.01},
      {"clearance over a gap", blocks(of_faces, pair_of("TYPE=SURFACE TO SURFACE") + clearance, 0.02), 0.02,
       squeezed + 0.01},
      {"tied", blocks(of_faces, tied, 0, -1), 0, -squeezed},
      {"TIED", blocks(of_faces, pair_of("TYPE=SURFACE TO SURFACE, TIED"), 0, -1), 0, -squeezed},
      {"tie", blocks(of_faces, "*TIE, NAME=T\nSLAVE, MASTER\n", 0, -1), 0, -squeezed},
      {"tie of nodes", blocks(of_nodes, "*TIE, NAME=T\nSLAVE, MASTER\n", 0, -1), 0, -squeezed},
      {"tie over a gap", blocks(of_faces, "*TIE, NAME=T, ADJUST=NO\nSLAVE, MASTER\n", 0.02, -1), 0.02,
       -squeezed},
  };
  for (const auto& row : rows) {
    const auto sinks = -test::computed_text(row.text).displacement(0, {0, 0, 2 + row.gap}, 2);
    const bool adjusted = std::string(row.what).starts_with("ADJUST") && row.sinks == 0;
    // Nodes that are moved make the upper block higher by the gap.
    const double expected = adjusted ? pressure / young * (2 + row.gap) : row.sinks;
    EXPECT_NEAR(sinks, expected, 1e-9) << row.what;
  }
}

TEST(SurfacesOfFiles, OfNodesLeaveOutTheOthersOfTheirFaces) {
  const auto text = blocks("*NSET, NSET=MIDDLE\n105\n*SURFACE, NAME=SLAVE, TYPE=NODE\nMIDDLE, 1.\n",
                           pair_of("TYPE=NODE TO SURFACE"));
  const auto zone = inp::parse_input(text, "a.inp").runs.front().contact.front();
  EXPECT_EQ(zone.slave, "SLAVE.faces");
  EXPECT_EQ(zone.exclude_nodes, std::vector<std::string>{"SLAVE.beside"});
  EXPECT_EQ(zone.integration.by, study::ContactIntegration::nodes);
  const auto mesh = mesh::inp::mesh_of(mesh::inp::parse_content(text, "a.inp"));
  EXPECT_EQ(mesh.cell_group("SLAVE.faces")->items.size(), 4U);
  EXPECT_EQ(mesh.node_group("SLAVE.beside")->items.size(), 8U);
}

TEST(SurfacesOfFiles, WithoutMassAreMoreauJeanSteps) {
  const auto study =
      inp::parse_input(blocks(of_faces, pair_of("TYPE=MASSLESS"), 0, 1, "*DYNAMIC, EXPLICIT\n, 0.1\n"),
                       "a.inp")
          .runs.front();
  EXPECT_EQ(study.time.scheme, study::SchemeKind::moreau_jean);
  EXPECT_EQ(study.time.contact_mass, study::ContactMass::redistributed);
  EXPECT_DOUBLE_EQ(study.time.step, 1e-4);
}

TEST(SurfacesOfFiles, AreRefusedWhereTheyMeanNothing) {
  struct Bad {
    std::string text;
    std::string expected; ///< a part of the message
  };
  const std::string clearance = "*CLEARANCE, MASTER=MASTER, SLAVE=SLAVE, VALUE=0.01\n";
  for (const auto& [text, expected] : std::vector<Bad>{
           {blocks(of_faces, clearance), "found a clearance of two surfaces that are no contact pair"},
           {blocks("*NSET, NSET=MIDDLE\n105\n*SURFACE, NAME=SLAVE, TYPE=NODE\nMIDDLE\n",
                   "*TIE, NAME=T\nSLAVE, MASTER\n"),
            "found nodes of a tied surface that have no whole face"},
           {blocks(of_faces, pair_of("TYPE=OTHER")), "found TYPE=OTHER, expected NODE TO SURFACE"}}) {
    const auto fault = test::fault_of([&] { inp::parse_input(text, "a.inp"); });
    EXPECT_NE(fault.find(expected), std::string::npos) << fault;
  }
}

bool says(const inp::Input& input, const std::string& part) {
  return std::ranges::any_of(input.notes,
                             [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

TEST(SetsOfFiles, TakeTheNumbersThatThereAre) {
  const auto text =
      blocks(of_faces + "*NSET, NSET=SOME, GENERATE\n1, 999999999, 50\n*NSET, NSET=OTHERS\n1, 55\n",
             pair_of("TYPE=MORTAR"));
  const auto input = inp::parse_input(text, "a.inp");
  EXPECT_TRUE(says(input, "of which the file has 2 nodes; these are taken"));
  EXPECT_TRUE(says(input, "node 55 is not in the file and is left out of the set"));
  const auto mesh = mesh::inp::mesh_of(mesh::inp::parse_content(text, "a.inp"));
  EXPECT_EQ(mesh.node_group("SOME")->items.size(), 2U);
}

/// Mesh generators write faces and edges beside solids as elements of the plane, shells and trusses.
TEST(ElementsOfFiles, WithoutASectionAreSurfaces) {
  auto text = blocks(of_faces, pair_of("TYPE=MORTAR"));
  const std::string skin = "*ELEMENT, TYPE=CPS4, ELSET=SKIN\n901, 1, 2, 5, 4\n*ELEMENT, TYPE=T3D2, "
                           "ELSET=EDGE\n902, 1, 2\n*ELEMENT, TYPE=S4, ELSET=SHELL\n903, 2, 3, 6, 5\n";
  text.insert(text.find("*NSET, NSET=GROUND"), skin);
  const auto input = inp::parse_input(text, "a.inp");
  EXPECT_EQ(input.runs.front().physics, study::Physics::solid);
  EXPECT_TRUE(says(input, "1 elements of type CPS4 have no section: they are surfaces or lines without "
                          "stiffness"));
  EXPECT_NEAR(test::computed_text(text).displacement(0, {0, 0, 2}, 2), -squeezed, 1e-9);
}

} // namespace
} // namespace rubato::surfaces_test
