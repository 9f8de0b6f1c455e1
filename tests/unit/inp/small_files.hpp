// SPDX-License-Identifier: LGPL-3.0-or-later
/// Small .inp files as text.
#pragma once

#include <string>

namespace rubato::test {

/// Lines of the nodes 1 to 8 of a cube of side 1, in the order of C3D8.
inline const std::string cube_nodes = R"( 1, 0, 0, 0
 2, 1, 0, 0
 3, 1, 1, 0
 4, 0, 1, 0
 5, 0, 0, 1
 6, 1, 0, 1
 7, 1, 1, 1
 8, 0, 1, 1
)";

/// One cube with all that it needs before a step: 23 lines.
inline const std::string cube = "*NODE, NSET=ALL\n" + cube_nodes + R"(*ELEMENT, TYPE=C3D8R, ELSET=E
 1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=ONE
 1
*MATERIAL, NAME=STEEL
*ELASTIC
 2E11, 0.3
*DENSITY
 7800
*SOLID SECTION, ELSET=E, MATERIAL=STEEL
*BOUNDARY
 5, 1, 3
 6, 1, 3
 7, 1, 3
)";

/// The cube and a step of these lines, which begin in line 25.
inline std::string with_step(const std::string& lines, const std::string& step = "*STEP") {
  return cube + step + "\n" + lines + "*END STEP\n";
}

} // namespace rubato::test
