// SPDX-License-Identifier: LGPL-3.0-or-later
// What is refused, with one sentence and its place each.
#include "rubato/inp/read.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <gtest/gtest.h>

#include "small_files.hpp"
#include "support/faults.hpp"
#include <vector>

namespace rubato::bad_input_test {
namespace {

using test::fault_of;
using test::with_step;

struct Bad {
  std::string text;
  std::string expected; ///< how the message begins
};

void expect_faults(const std::vector<Bad>& rows) {
  for (const auto& row : rows) {
    const auto fault = fault_of([&] { inp::parse_input(row.text, "a.inp"); });
    EXPECT_TRUE(fault.starts_with(row.expected)) << "found    " << fault << "\nexpected " << row.expected;
    EXPECT_EQ(fault.find('\n'), std::string::npos) << "one sentence expected, found " << fault;
  }
}

/// The cube with one line in place of another.
std::string changed(const std::string& line, const std::string& into, const std::string& step = "*STATIC\n") {
  auto text = with_step(step);
  const auto at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  return text.replace(at, line.size(), into);
}

TEST(BadInp, WordsOfTheFormat) {
  expect_faults({
      {changed("*MATERIAL", "*MATRIAL"),
       "a.inp:14:1: found '*MATRIAL', which is no keyword of Abaqus or CalculiX; did you mean '*MATERIAL'?"},
  });
}

TEST(BadInp, Meshes) {
  expect_faults({
      {"1, 0, 0\n" + with_step("*STATIC\n"),
       "a.inp:1:1: found '1, 0, 0' before the first keyword, expected a line that "
       "begins with '*'"},
      {changed(" 2, 1, 0, 0", " 2, 1, x, 0"), "a.inp:3:8: found 'x', expected a coordinate, a number"},
      {changed(" 2, 1, 0, 0", " 0, 1, 0, 0\n 2, 1, 0, 0"),
       "a.inp:3:2: found 0, expected the number of a node from 1 to 999999999"},
      {changed(" 2, 1, 0, 0", " 2, 1, 0, 0\n 2, 5, 0, 0"),
       "a.inp:4:2: found node 2 a second time at another place, expected "
       "each number once"},
      {changed("TYPE=C3D8R", "TYPE=C3D9"),
       "a.inp:10:16: found elements of type 'C3D9', which rubato does not have; the "
       "nearest it has is C3D4"},
      {changed("5, 6, 7, 8\n", "5, 6, 7, 80\n"),
       "a.inp:11:26: found node 80 of element 1, which the file does not have"},
      {changed("5, 6, 7, 8\n", "5, 6, 7\n"), "a.inp:11:2: found 7 nodes of a C3D8R element, expected 8"},
      {changed("5, 6, 7, 8\n", "5, 6, 7, 7\n"),
       "a.inp:11:2: found element 1 with a node twice, expected 8 different nodes"},
      {changed("*NSET, NSET=ONE\n 1\n", "*NSET, NSET=ONE\n AL\n"),
       "a.inp:13:2: found 'AL', expected the number of a node or a set "
       "of nodes; did you mean 'ALL'?"},
      {changed("*NSET, NSET=ONE\n 1\n", "*NSET, NSET=ONE, GENERATE\n 9, 1, 2\n"),
       "a.inp:13:2: found numbers from 9 to 1 by 2, expected some above 0 that ascend"},
      {changed("*MATERIAL", "*SURFACE, NAME=S\n E, S7\n*MATERIAL"),
       "a.inp:15:5: found the face 'S7', expected S1 to S6"},
      {changed("*MATERIAL", "*ELEMENT, TYPE=CPS4, ELSET=F\n 2, 1, 2, 3, 4\n*SOLID SECTION, ELSET=F, "
                            "MATERIAL=STEEL\n*MATERIAL"),
       "a.inp:15:2: found a CPS4 element beside C3D8R in line 11, expected one physics in a file"},
      {changed("*MATERIAL", "*PART, NAME=P\n*MATERIAL"),
       "a.inp:14:1: found *PART without its end, expected *END PART after it"},
      {changed("*MATERIAL", "*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*MATERIAL"),
       "a.inp:14:25: found the part 'P', which the file does not have above"},
      {changed("*MATERIAL", "*INCLUDE, INPUT=none.inc\n*MATERIAL"),
       "a.inp:14:17: mesh file 'none.inc' does not exist"},
  });
}

TEST(BadInp, Models) {
  expect_faults({
      {changed("*DENSITY\n 7800", "*CLAY PLASTICITY\n 2E8, 0."),
       "a.inp:17:1: found *CLAY PLASTICITY, which rubato does not have: there is no such material"},
      {changed(" 2E11, 0.3", " 2E11, 0.3, 20., 5."),
       "a.inp:16:2: found 4 numbers of *ELASTIC, expected Young's modulus and Poisson's ratio, and perhaps a "
       "temperature"},
      {changed("*DENSITY\n 7800", "*PLASTIC\n 2E8, 0.\n 1E8, 0.1"),
       "a.inp:14:17: materials.STEEL.hardening.table.1.1: found 100000000 after 200000000, expected stresses "
       "that "
       "do not fall"},
      {changed("*DENSITY\n 7800", "*PLASTIC\n 2E8, 0.1\n 3E8, 0.1"),
       "a.inp:19:7: found the plastic strain 0.1 after 0.1, expected strains that ascend"},
      {changed("*DENSITY\n 7800", "*PLASTIC, RATE=1.\n 2E8, 0."),
       "a.inp:17:11: found yield stresses by the rate of plastic strain"},
      {changed("*DENSITY\n 7800", "*PLASTIC, HARDENING=KINEMATIC\n 2E8, 0.\n 3E8, 0.1\n 4E8, 0.5"),
       "a.inp:17:1: found kinematic hardening along several slopes"},
      {changed("*DENSITY\n 7800", "*CYCLIC HARDENING\n 2E8, 0."),
       "a.inp:17:1: found *CYCLIC HARDENING without *PLASTIC above it"},
      {changed("*ELASTIC\n 2E11, 0.3", "*HYPERELASTIC, ARRUDA-BOYCE\n 1., 5., 0.1"),
       "a.inp:15:16: found ARRUDA-BOYCE, expected the coefficients of NEO HOOKE"},
      {changed("*ELASTIC\n 2E11, 0.3", "*HYPERELASTIC, POLYNOMIAL, N=2\n 1., 0., 0., 0.1, 0., 0.1"),
       "a.inp:15:1: found a polynomial of I2 of the second order"},
      {changed("*ELASTIC\n 2E11, 0.3", "*HYPERELASTIC, YEOH\n 1., 0., 0., 0.1, 0.1"),
       "a.inp:15:1: found D2 or D3, the compressibility of higher order"},
      {changed("*DENSITY\n 7800", "*VISCOELASTIC, TIME=PRONY\n 0.3, 0.1, 2."),
       "a.inp:18:7: found k = 0.1, a bulk modulus that relaxes"},
      {changed("*DENSITY\n 7800", "*VISCOELASTIC, TIME=PRONY\n 0.3, 0., 2."),
       "a.inp:25:1: found *STATIC with the material 'STEEL', which has *VISCOELASTIC"},
      {changed("*DENSITY\n 7800", "*CREEP\n 1E-10, 5., 0.", "*VISCO\n"),
       "a.inp:25:1: found *VISCO with the material 'STEEL', which has *CREEP"},
      {changed("*DENSITY\n 7800\n", "", "*STATIC\n*DLOAD\n E, GRAV, 9.81, 0., 0., -1.\n"),
       "a.inp:25:2: found GRAV on elements of 'STEEL', which has no *DENSITY"},
      {changed(" 2E11, 0.3", " -2E11, 0.3"),
       "a.inp:14:17: materials.STEEL.young: found '-200000000000', expected a number > 0"},
      {changed("*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n", ""),
       "a.inp:11:2: found element 1 (C3D8R) in no set of a *SOLID SECTION, "
       "expected one"},
      {changed(" 5, 1, 3", " 5, 1, 7"),
       "a.inp:21:5: found the degrees of freedom 1 to 7, expected some from 1 to 6"},
      {changed(" 5, 1, 3", " 5, ENCASTER"),
       "a.inp:21:5: found 'ENCASTER', expected a degree of freedom or a named support; did you "
       "mean 'ENCASTRE'?"},
      {changed(" 5, 1, 3", " 5, 1, 3, 0.5"),
       "a.inp:21:11: found the displacement 0.5 outside of a step, expected it in one"},
      {changed("*BOUNDARY", "*CLOAD\n 1, 1, 1.\n*BOUNDARY"),
       "a.inp:20:1: found *CLOAD outside of a step, expected it in one"},
      {changed("*BOUNDARY", "*ELEMENT, TYPE=S4, ELSET=SHELL\n 9, 1, 2, 3, 4\n*SOLID SECTION, ELSET=SHELL, "
                            "MATERIAL=STEEL\n*BOUNDARY"),
       "a.inp:21:2: found S4 elements, expected solids: there are no shells, membranes, beams, trusses and "
       "rigid elements"},
      {changed("*BOUNDARY", "*CONTACT PAIR, INTERACTION=I\n A, B\n*BOUNDARY"),
       "a.inp:20:28: found 'I', expected the name of an interaction of the file"},
      {changed("*BOUNDARY", "*FRICTION\n 0.3\n*BOUNDARY"),
       "a.inp:20:1: found *FRICTION without *SURFACE INTERACTION above it, "
       "which it belongs to"},
      {changed("*BOUNDARY", "*EQUATION\n 2\n 1, 1, 1., 2, 4, 1.\n*BOUNDARY"),
       "a.inp:22:15: found the degree of freedom 4 of node 2, expected a displacement of a node of a body, 1 "
       "to 3"},
      {changed("*BOUNDARY", "*INITIAL CONDITIONS, TYPE=STRESS\n E, 1.\n*BOUNDARY"),
       "a.inp:20:27: found TYPE=STRESS, expected VELOCITY, DISPLACEMENT or TEMPERATURE"},
  });
}

TEST(BadInp, Steps) {
  expect_faults({
      {test::cube, "a.inp: found no *STEP in the file, expected at least one"},
      {test::cube + "*STEP\n*STATIC\n",
       "a.inp:24:1: found *STEP without its end, expected *END STEP after it"},
      {with_step(""),
       "a.inp:24:1: found a step without *STATIC, *VISCO, *DYNAMIC or *FREQUENCY, expected one of them"},
      {with_step("*STATIC\n", "*STEP, NLGEOM=MAYBE"), "a.inp:24:15: found NLGEOM=MAYBE, expected YES or NO"},
      {with_step("*STATIC\n", "*STEP, PERTURBATION"),
       "a.inp:24:8: found PERTURBATION, which *FREQUENCY takes alone"},
      {with_step("*HEAT TRANSFER\n*STATIC\n"),
       "a.inp:25:1: found *HEAT TRANSFER, which rubato does not have: heat and other fields are "
       "not computed"},
      {with_step("*STATIC, RIKS\n"),
       "a.inp:25:10: found the parameter 'RIKS' of *STATIC, which has no counterpart in rubato"},
      {with_step("*STATIC\n*DYNAMIC, ALPHA=0.\n"),
       "a.inp:26:1: found *DYNAMIC beside *STATIC in line 25, expected one analysis in a step"},
      {with_step("*STATIC\n*MATERIAL, NAME=B\n"),
       "a.inp:26:1: found *MATERIAL in a step, expected it before the first one"},
      {with_step("*FREQUENCY\n 3, , , 100.\n"), "a.inp:26:9: found the shift 100., around which modes"},
      {with_step("*FREQUENCY\n 3, 50., 20.\n"),
       "a.inp:26:10: found 20 as the highest frequency, expected more than the lowest, 50"},
      {with_step("*STATIC\n*END STEP\n*STEP, PERTURBATION\n*FREQUENCY\n 3\n"),
       "a.inp:28:1: found *FREQUENCY after a static or dynamic step with PERTURBATION: its modes are about "
       "the "
       "bodies under the stress of that step"},
      {with_step("*STATIC\n*END STEP\n*STEP\n*FREQUENCY\n 3\n", "*STEP, NLGEOM"),
       "a.inp:28:1: found *FREQUENCY after a static or dynamic step with NLGEOM"},
      {with_step("*STATIC\n*CHANGE FRICTION, INTERACTION=I\n*FRICTION\n 0.1\n"),
       "a.inp:26:31: found 'I', expected the name of an interaction"},
      {with_step("*STATIC\n*MODEL CHANGE, TYPE=ELEMENT, ADD\n E\n"),
       "a.inp:26:30: found elements that are added free of strain"},
      {with_step("*STATIC\n*MODEL CHANGE, TYPE=CONTACT PAIR\n A, B\n"),
       "a.inp:26:1: found *MODEL CHANGE without ADD or REMOVE"},
      {with_step("*DYNAMIC, ALPHA=-0.4\n 0.1, 1.\n"),
       "a.inp:25:1: time.alpha: found '-0.4', expected a number"},
      {with_step("*DYNAMIC, APPLICATION=QUASI-STATIC\n 0.1, 1.\n"),
       "a.inp:25:23: found APPLICATION=QUASI-STATIC, whose scheme rubato does "
       "not have"},
      {with_step("*STATIC\n*CLOAD\n ONE, 4, 1.\n"),
       "a.inp:27:7: found a force along the degree of freedom 4, which these nodes do not have"},
      {with_step("*STATIC\n*CLOAD, AMPLITUDE=A\n ONE, 1, 1.\n"),
       "a.inp:26:19: found 'A', expected the name of an *AMPLITUDE of the file"},
      {with_step("*STATIC\n*CLOAD, OP=ADD\n ONE, 1, 1.\n"), "a.inp:26:12: found OP=ADD, expected NEW or MOD"},
      {with_step("*STATIC\n*DLOAD\n E, P7, 1.\n"),
       "a.inp:27:5: found the load 'P7', expected P1 to P6 of a set, GRAV, CENTRIF, BX, BY or BZ"},
      {with_step("*STATIC\n*DSLOAD\n TOP, P, 1.\n"), "a.inp:27:2: found 'TOP', expected a surface"},
      {with_step("*DYNAMIC, EXPLICIT\n , 1.\n*BOUNDARY\n 1, 1, 1, 0.1\n"),
       "a.inp:28:2: found the displacement 0.1 at once, a jump, expected AMPLITUDE= in an explicit step"},
      {with_step("*STATIC\n*BOUNDARY\n 1, 1, 1, 0.1\n*BOUNDARY\n 1, 1, 1, 0.2\n"),
       "a.inp:29:2: found a second value of this displacement of 'N1', expected one; the other is in line "
       "27"},
      {with_step("*STATIC\n*END STEP\n*STEP\n*DYNAMIC, ALPHA=0.\n 0.1, 1.\n*BOUNDARY\n 1, 1, 1, 0.1\n"),
       "a.inp:31:2: found a support of 'N1' that begins in the dynamic step 2"},
      {with_step("*STATIC\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, FIXED\n 1, 1\n"),
       "a.inp:30:2: found FIXED with nodes of 'N1', whose displacements are not known"},
      {with_step("*STATIC\n*CLOAD\n ONE, 1, 1.\n*END STEP\n*STEP\n*STATIC\n*CLOAD\n ALL, 1, 1.\n"),
       "a.inp:32:2: found a load on a part of what another step loads, expected the same set"},
      {with_step("*STATIC\n*DLOAD\n E, GRAV, 1., 1., 0., 0.\n*END STEP\n*STEP\n*STATIC\n*DLOAD\n E, GRAV, "
                 "1., 0., 1., 0.\n"),
       "a.inp:32:2: found a load on a part of what another step loads, expected the same set and direction, "
       "or OP=NEW"},
      {with_step("*DYNAMIC, ALPHA=0.\n 0.1, 1.\n*BOUNDARY, TYPE=VELOCITY\n 1, 1, 1, 2.\n*END "
                 "STEP\n*STEP\n*DYNAMIC, ALPHA=0.\n 0.1, 1.\n"),
       "a.inp:28:2: found a velocity or an acceleration of a support that goes on in step 2"},
      {"*RESTART, READ, STEP=1\n" + with_step("*STATIC\n"),
       "a.inp:1:11: found a restart from another analysis"},
      {with_step("*STATIC\n 1., -1.\n"),
       "a.inp:26:2: found a negative time of a step, expected times above 0"},
      {with_step("*STATIC\n*AMPLITUDE, NAME=A\n 0., 0., 0., 1.\n*CLOAD, AMPLITUDE=A\n ONE, 1, 1.\n"),
       "a.inp:26:1: found the time 0 after 0, expected times that ascend"},
  });
}

TEST(BadInp, WhatFollowsFromAFaultIsToldWithIt) {
  EXPECT_EQ(fault_of([] { inp::parse_input(changed("*NSET, NSET=ONE", "*NSET, NST=ONE"), "a.inp"); }),
            "a.inp:12:1: found *NSET without NSET=, expected the name of the set\n"
            "a.inp:12:8: found the parameter 'NST' of *NSET, which has no counterpart in rubato; did you "
            "mean 'NSET'?");
  EXPECT_EQ(fault_of([] { inp::parse_input(changed("MATERIAL=STEEL", "MATERIAL=STEAL"), "a.inp"); }),
            "a.inp:11:2: found element 1 (C3D8R) in no set of a *SOLID SECTION, expected one\n"
            "a.inp:19:35: found 'STEAL', expected the name of a material of the file; did you mean 'STEEL'?");
}

TEST(BadInp, FaultsOfAllPartsAreToldTogether) {
  const auto text = "*NSET, NSET=A\n 1\n*NODE\n 1, x\n";
  const auto fault = fault_of([&] { mesh::inp::parse_content(text, "a.inp"); });
  EXPECT_EQ(fault, "a.inp:4:5: found 'x', expected a coordinate, a number");
  const auto both = fault_of([] {
    inp::parse_input(with_step("*STATIC\n*CLOAD\n ONE, 1, one\n*DSLOAD\n NONE, P, 1.\n", "*STEP, NLGEOM=X"),
                     "a.inp");
  });
  EXPECT_EQ(std::count(both.begin(), both.end(), '\n'), 2) << both;
  EXPECT_TRUE(both.starts_with("a.inp:24:15: found NLGEOM")) << both;
}

} // namespace
} // namespace rubato::bad_input_test
